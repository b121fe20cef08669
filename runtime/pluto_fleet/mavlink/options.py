"""The options of MAVLink vehicles in a fleet file: `[navigation.mavlink]`, overridden by `[drone.options]`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Literal

from msgspec import Meta, Struct, ValidationError, convert

from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted

_Metres = Annotated[float, Meta(gt=0.0, le=20.0)]
_Speed = Annotated[float, Meta(gt=0.0, le=20.0)]
MOST_CELLS = 14


class VehicleOptions(Struct, frozen=True, kw_only=True):
    """The validated options."""

    autopilot: Literal["px4", "ardupilot"] | None = None
    """Whose it must be; None: either's. Of a simulated one, whose it is: by default PX4's."""
    reach: _Metres = 0.5
    """Metres from a target within which it has arrived."""
    still: _Speed = 0.3
    """Metres per second below which it counts as hovering."""
    dock: _Metres = 3.0
    """Metres from its home within which it must stand to take off for the first time."""
    addresses: tuple[str, ...] = ("mavlink+udp://:14540", "mavlink+udp://:14550")
    """Where `drones` listens for vehicles: PX4 sends to both of these ports when it is simulated, and most radios to the second."""
    fence: bool = True
    """Whether its autopilot is given the map as its fence, in place of the one that it has."""
    beyond: _Metres = 5.0
    """Metres by which that fence is farther out than the map, and higher than its ceiling."""
    cells: Annotated[int, Meta(ge=1, le=MOST_CELLS)] | None = None
    """The number of its battery's cells in series, by which its voltage says how full it is; None: only it says so itself."""


_WANTED = {
    "autopilot": '"px4" or "ardupilot"',
    "reach": "a number of metres above 0, at most 20",
    "still": "a number of metres per second above 0, at most 20",
    "dock": "a number of metres above 0, at most 20",
    "addresses": 'a list of texts, such as ["mavlink+udp://:14550"]',
    "fence": "true or false",
    "beyond": "a number of metres above 0, at most 20",
    "cells": f"a whole number from 1 to {MOST_CELLS}",
}
"""What each must be, for people."""


def options_of(given: Mapping[str, object]) -> VehicleOptions:
    """Read the options; raise `BadInput` with the key that is invalid."""
    for key in given:
        if key not in _WANTED:
            raise BadInput(
                f"a MAVLink vehicle has no option {quoted(key)}; it has {', '.join(_WANTED)}"
            )
    try:
        return convert(dict(given), VehicleOptions)
    except ValidationError as error:
        key = re.split(r"[`.\[]", str(error).rpartition("`$.")[2])[0]
        raise BadInput(f"its option {key} must be {_WANTED[key]}") from error
