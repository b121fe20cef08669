"""The options of Crazyflies in a fleet file: `[navigation.crazyflie]`, overridden by `[drone.options]`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import sqrt
from sys import float_info
from typing import Annotated, Any

from msgspec import Meta, Struct
from msgspec.structs import replace

from ..drones.equipment import source_of
from ..drones.options import bad_option, read_options
from ..files.addresses import USUAL, radio_bytes
from ..shared.domain.actions import BUILT_IN, PICK
from ..shared.domain.errors import BadInput
from ..shared.domain.text import number

_LONGEST = 10.0
_CELLS = 6
_LEAST_VOLTAGE = 3.7
SURE_WITHIN = 0.07
"""Metres: with radio beacons (Loco) it is sure to five centimetres, with others to two."""
LOST_BEYOND = sqrt(0.05)
"""Metres, about 0.22: three times the largest deviation while it receives its beacons."""

_Number = Annotated[float, Meta(ge=-float_info.max, le=float_info.max)]
_NotNegative = Annotated[float, Meta(ge=0.0, le=float_info.max)]
_Metres = Annotated[float, Meta(gt=0.0, le=_LONGEST)]
_Degrees = Annotated[float, Meta(gt=0.0, lt=180.0)]
_Port = Annotated[int, Meta(ge=1, le=65535)]
_Name = Annotated[str, Meta(pattern=r"\A[^.]+\.[^.]+\Z")]
"""A name as in the firmware: a group, a dot and a name."""


class Gripper(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A gripper deck, controlled by a parameter."""

    parameter: _Name
    pick: _Number
    release: _Number
    seconds: _NotNegative = BUILT_IN[PICK].seconds
    """How long it takes to close or to open."""


class CrazyflieOptions(Struct, frozen=True, kw_only=True):
    """The validated options."""

    measure: dict[str, _Name] = {}
    """The log variable of each quantity that can be measured; `ANY_OTHER`: of all others."""
    measure_seconds: _NotNegative = 1.0
    """Seconds over which a measurement is averaged."""
    camera: tuple[str, _Port] | None = None
    """The address of the AI-deck's streamer."""
    camera_view: tuple[_Degrees, _Degrees] = (65.0, 50.0)
    """The field of view in degrees: across and along."""
    grip: Gripper | None = None
    decks: tuple[str, ...] = ()
    """The decks that it must have, as the firmware names them."""
    cells: Annotated[int, Meta(ge=1, le=_CELLS)] = 1
    """The number of cells in series: two on a Bolt or a Flapper."""
    least_voltage: _NotNegative = _LEAST_VOLTAGE
    """Volts of a cell at rest below which it does not take off."""
    sure_within: _Metres = SURE_WITHIN
    """The largest standard deviation of its position for a take-off, in metres."""
    lost_beyond: _Metres = LOST_BEYOND
    """The largest standard deviation of its position in the air, in metres: beyond, it lands."""
    starts_at_home: bool = False
    """It only measures its relative movement: its position is set to its home at the start."""
    addresses: tuple[str, ...] = (USUAL,)
    """Radio addresses to scan."""
    udp: tuple[str, ...] = ()
    """Addresses of simulated drones to scan."""

    def variable_of(self, quantity: str) -> str | None:
        """Return the log variable of a quantity; None: it has none."""
        return source_of(self.measure, quantity)


_METRES = f"a number of metres above 0, at most {_LONGEST:g}"
_TEXTS = 'a list of texts, such as ["bcLighthouse4"]'
_WANTED = {
    "measure": 'a table of log variables, such as { temperature = "bme.temp" }',
    "measure_seconds": "a number from 0 on",
    "camera": 'a host and a port, such as "192.168.4.1:5000"',
    "camera_view": "two angles in degrees, such as [65, 50]",
    "grip": 'a table, such as { parameter = "gripper.closed", pick = 1, release = 0 }',
    "decks": _TEXTS,
    "cells": f"a whole number from 1 to {_CELLS}",
    "least_voltage": "a number from 0 on",
    "sure_within": _METRES,
    "lost_beyond": _METRES,
    "starts_at_home": "true or false",
    "addresses": _TEXTS,
    "udp": _TEXTS,
}
"""What each must be, for people."""


def options_of(given: Mapping[str, object]) -> CrazyflieOptions:
    """Read the options; raise `BadInput` with the key that is invalid."""
    read: dict[str, Any] = dict(given)
    for key in ("decks", "addresses", "udp"):
        if isinstance(read.get(key), str):
            read[key] = [read[key]]
    if isinstance(read.get("camera"), str):
        host, _, port = read["camera"].rpartition(":")
        is_port = host and re.fullmatch("[0-9]{1,5}", port)
        read["camera"] = [host.strip("[]"), int(port)] if is_port else ()
    options = read_options(read, CrazyflieOptions, _WANTED, "a Crazyflie")
    if "lost_beyond" not in given:
        options = replace(options, lost_beyond=max(LOST_BEYOND, options.sure_within))
    if options.lost_beyond < options.sure_within:
        raise bad_option(
            "lost_beyond", f"at least sure_within, which is {number(options.sure_within)}"
        )
    try:
        addresses = tuple(radio_bytes(one).hex().upper() for one in options.addresses)
    except ValueError as error:
        raise BadInput(f"its option addresses: {error}") from error
    return replace(options, addresses=addresses)
