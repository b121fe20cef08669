"""Drones that are simulated down to their protocol, and flown as real ones are: which, how many, and where they stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import TYPE_CHECKING, Any

from ..geodesy import LocalPlane
from ..jobs.landing_sites import free_spots
from ..shared.domain.errors import BadInput
from .fleet import (
    CRAZYFLIE,
    DEFAULT_SIZE,
    MAVLINK,
    OWN,
    DroneEntry,
    FleetFile,
    default_fleet,
    fleet_of,
    navigation_of,
)
from .reading import parsed

if TYPE_CHECKING:
    from ..app import App

CRTP = "crtp"
MAVLINK_SIM = "mavlink"
_NAVIGATION = {CRTP: CRAZYFLIE, MAVLINK_SIM: MAVLINK}
_NAMES = {CRTP: "cf", MAVLINK_SIM: "m"}
"""How drones begin to be called that no fleet file names."""

SOMEWHERE = LocalPlane(47.397742, 8.545594, 488.0)
"""Where a map lies that does not say it: where vehicles that PX4 simulates are."""


@dataclass(frozen=True, slots=True)
class StandIns:
    """So many drones of a kind."""

    kind: str
    number: int

    @property
    def flag(self) -> str:
        """How it is said on the command line."""
        return f"--{self.kind}-sim {self.number}"

    @property
    def header(self) -> dict[str, object]:
        """How it is written in a journal's first row."""
        return {key_of(self.kind): self.number}


def key_of(kind: str) -> str:
    return f"{kind}_sim"


def stand_ins_in(header: Mapping[str, Any]) -> StandIns | None:
    """Return what a journal's first row says of them, or None."""
    for kind in _NAVIGATION:
        if (number := header.get(key_of(kind))) is not None:
            return StandIns(kind, number)
    return None


def fleet_from(app: App, name: str, text: str | None, stand_ins: StandIns | None) -> FleetFile:
    """Return the fleet of a file's text, or the default fleet; optionally as drones that stand in for it."""
    if text is None:
        fleet = default_fleet(app, DEFAULT_SIZE if stand_ins is None else stand_ins.number)
    else:
        fleet = fleet_of(parsed(name, text), app)
    return fleet if stand_ins is None else as_stand_ins(fleet, stand_ins)


def as_stand_ins(fleet: FleetFile, stand_ins: StandIns) -> FleetFile:
    """Return a fleet of this many drones, each simulated down to its protocol.

    They are the first of the fleet file; further ones are copies of them, placed beside them.
    """
    number = stand_ins.number
    navigation = _NAVIGATION[stand_ins.kind]
    drones = [_as(navigation, fleet, one) for one in fleet.drones[:number]]
    for place in range(len(drones), number):
        taken = [one.home for one in drones]
        beside = max(fleet.apart, _APART)
        home = next(free_spots(fleet.airspace, taken[-1], taken, beside), None)
        if home is None:
            raise BadInput(
                f"{stand_ins.flag}: this map has room for {place} drones, which stand"
                f" {beside:g} m apart: fly fewer, or let the fleet file say where they stand"
            )
        like = drones[place % len(fleet.drones)]
        drones.append(replace(like, id=_free_id(_NAMES[stand_ins.kind], drones), home=home))
    landmarks = fleet.landmarks
    if landmarks.plane is None and stand_ins.kind == MAVLINK_SIM:
        landmarks = replace(landmarks, plane=SOMEWHERE)
    return replace(
        fleet,
        drones=tuple(drones),
        navigation=navigation,
        localization=OWN,
        tracker=None,
        landmarks=landmarks,
    )


def missing_categories(fleet: FleetFile, stand_ins: StandIns) -> str | None:
    """Return a sentence that names the categories which the first drones of a fleet lack; None: none."""
    number = stand_ins.number
    there = {one.category for one in fleet.drones[:number]}
    missing = dict.fromkeys(one.category for one in fleet.drones if one.category not in there)
    if not missing:
        return None
    return (
        f"no {' and no '.join(missing)} flies: {stand_ins.flag} takes only {number} of the fleet"
        f" file's {len(fleet.drones)} drones, from its top"
    )


def _as(navigation: str, fleet: FleetFile, one: DroneEntry) -> DroneEntry:
    """Return a drone as it is flown by a navigation; options for another one are dropped."""
    options = one.options if navigation_of(fleet, one) == navigation else {}
    return replace(one, navigation=None, uri=None, options=options)


_APART = 0.7
"""Metres between drones that the fleet file does not place."""


def _free_id(begins: str, drones: Sequence[DroneEntry]) -> str:
    """Return the first unused default name."""
    known = {one.id for one in drones}
    return next(id for number in count(1) if (id := f"{begins}{number}") not in known)
