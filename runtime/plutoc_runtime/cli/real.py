"""Before real drones are flown: what can be known to be wrong without any radio."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING

from ..crazyflie.borrowed import require
from ..drones.loading import load_localization, load_navigation
from ..errors import BadInput
from ..files.behaviour import CRAZYFLIE, OWN
from ..files.reading import shortened
from ..files.real import navigation_of, not_real
from ..gateway.spots import free_spot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..files.drones import DroneEntry
    from ..files.fleet import FleetFile


def check_real(fleet: FleetFile, where: str, *, stand_ins: bool) -> None:
    """Raise `BadInput` if this fleet cannot be flown from here; nothing has started.

    `where` its file is, for whoever must mend it.
    """
    problems = [] if stand_ins else not_real(fleet)
    if problems:
        raise BadInput(shortened([f"{where}: {sentence}" for sentence in problems]))
    names = dict.fromkeys(navigation_of(fleet, drone) for drone in fleet.drones)
    if CRAZYFLIE in names:
        require()
    for name in names:
        load_navigation(name)
    if fleet.localization != OWN:
        load_localization(fleet.localization)


def with_stand_ins(fleet: FleetFile, number: int) -> FleetFile:
    """Return a fleet of so many drones, each a Crazyflie that is simulated down to its radio.

    They are the first of the fleet file; those that it lacks are like them, and stand beside them.
    """
    drones = [replace(one, navigation=None, uri=None) for one in fleet.drones[:number]]
    for place in range(len(drones), number):
        taken = [one.home for one in drones]
        home = free_spot(fleet.airspace, taken[-1], taken, max(fleet.apart, _BESIDE))
        like = drones[place % len(fleet.drones)]
        drones.append(replace(like, id=_free_id(drones), home=home))
    return replace(fleet, drones=tuple(drones), navigation=CRAZYFLIE, localization=OWN)


_BESIDE = 0.7
"""Metres between drones that nobody has placed."""


def _free_id(drones: Sequence[DroneEntry]) -> str:
    """Return the first name of the usual ones that no drone has."""
    known = {one.id for one in drones}
    return next(id for number in count(1) if (id := f"cf{number}") not in known)
