"""The options of MAVLink vehicles in a fleet file: `[navigation.mavlink]`, overridden by `[drone.options]`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from msgspec import Meta, Struct

from ..drones.equipment import source_of
from ..drones.options import read_options

_Metres = Annotated[float, Meta(gt=0.0, le=20.0)]
_Speed = Annotated[float, Meta(gt=0.0, le=20.0)]
MOST_CELLS = 14
_Seconds = Annotated[float, Meta(ge=0.0, le=60.0)]
_Name = Annotated[str, Meta(min_length=1, max_length=10)]
"""The name of a NAMED_VALUE_FLOAT."""


class Gripper(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A gripper that its autopilot moves."""

    number: Annotated[int, Meta(ge=1, le=255)]
    """Which of its grippers, counted from 1."""
    seconds: _Seconds = 1.0
    """How long it takes to close or to open."""


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
    measure: dict[str, _Name] = {}
    """The name under which each quantity is told that can be measured; `ANY_OTHER`: all others."""
    measure_seconds: _Seconds = 1.0
    """Seconds over which a measurement is averaged."""
    grip: Gripper | None = None

    def name_of(self, quantity: str) -> str | None:
        """Return the name under which a quantity is told; None: none is known."""
        return source_of(self.measure, quantity)


_WANTED = {
    "autopilot": '"px4" or "ardupilot"',
    "reach": "a number of metres above 0, at most 20",
    "still": "a number of metres per second above 0, at most 20",
    "dock": "a number of metres above 0, at most 20",
    "addresses": 'a list of texts, such as ["mavlink+udp://:14550"]',
    "fence": "true or false",
    "beyond": "a number of metres above 0, at most 20",
    "cells": f"a whole number from 1 to {MOST_CELLS}",
    "measure": 'a table of names of at most ten characters, such as { pm10 = "pm10" }',
    "measure_seconds": "a number from 0 to 60",
    "grip": "a table, such as { number = 1 }, perhaps with the seconds that it takes",
}
"""What each must be, for people."""


def options_of(given: Mapping[str, object]) -> VehicleOptions:
    """Read the options; raise `BadInput` with the key that is invalid."""
    return read_options(given, VehicleOptions, _WANTED, "a MAVLink vehicle")
