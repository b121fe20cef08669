"""A fleet of simulated Crazyflies instead of the one that a fleet file describes."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING

from ..files.fleet import CRAZYFLIE, OWN, navigation_of
from ..jobs.landing_sites import free_spots
from ..shared.domain.errors import BadInput
from .fleet import DEFAULT_SIZE, FleetFile, default_fleet, fleet_of
from .reading import parsed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..app import App
    from .drones import DroneEntry


def fleet_from(app: App, name: str, text: str | None, crtp_sim: int | None) -> FleetFile:
    """Return the fleet of a file's text, or the default fleet; optionally as simulated Crazyflies."""
    if text is None:
        return default_fleet(app, crtp_sim or DEFAULT_SIZE)
    fleet = fleet_of(parsed(name, text), app)
    return fleet if crtp_sim is None else as_crtp_fleet(fleet, crtp_sim)


def as_crtp_fleet(fleet: FleetFile, number: int) -> FleetFile:
    """Return a fleet of this many drones, each a Crazyflie that is simulated down to its radio.

    They are the first of the fleet file; further ones are copies of them, placed beside them.
    """
    drones = [_as_crazyflie(fleet, one) for one in fleet.drones[:number]]
    for place in range(len(drones), number):
        taken = [one.home for one in drones]
        beside = max(fleet.apart, _APART)
        home = next(free_spots(fleet.airspace, taken[-1], taken, beside), None)
        if home is None:
            raise BadInput(
                f"--crtp-sim {number}: this map has room for {place} drones, which stand"
                f" {beside:g} m apart: fly fewer, or let the fleet file say where they stand"
            )
        like = drones[place % len(fleet.drones)]
        drones.append(replace(like, id=_free_id(drones), home=home))
    return replace(fleet, drones=tuple(drones), navigation=CRAZYFLIE, localization=OWN)


def missing_categories(fleet: FleetFile, number: int) -> str | None:
    """Return a sentence that names the categories which the first drones of a fleet lack; None: none."""
    there = {one.category for one in fleet.drones[:number]}
    missing = dict.fromkeys(one.category for one in fleet.drones if one.category not in there)
    if not missing:
        return None
    return (
        f"no {' and no '.join(missing)} flies: --crtp-sim {number} takes only {number} of the fleet"
        f" file's {len(fleet.drones)} drones, from its top"
    )


def _as_crazyflie(fleet: FleetFile, one: DroneEntry) -> DroneEntry:
    """Return a drone as a Crazyflie; options for another navigation are dropped."""
    options = one.options if navigation_of(fleet, one) == CRAZYFLIE else {}
    return replace(one, navigation=None, uri=None, options=options)


_APART = 0.7
"""Metres between drones that the fleet file does not place."""


def _free_id(drones: Sequence[DroneEntry]) -> str:
    """Return the first unused default name."""
    known = {one.id for one in drones}
    return next(id for number in count(1) if (id := f"cf{number}") not in known)
