"""Could the fleet ever do what the missions ask? Asked before anything flies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import dist
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import BUILT_IN
from plutoc_runtime.domain.fields import Entity, FieldType
from plutoc_runtime.domain.text import quoted
from plutoc_runtime.fleet.capability import Lacks, Miss, chain_of, miss_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Category, Mission, Point, Trip

    from .fleet import FleetFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Unflyable:
    """Trips that one drone must fly, and none of the fleet ever could."""

    mission: Mission[Any]
    trips: Sequence[Trip]
    reason: str

    @property
    def called(self) -> str:
        """How a message calls them."""
        names = [trip.name if trip.name.isdigit() else quoted(trip.name) for trip in self.trips]
        trips = f"trip {names[0]}" if len(names) == 1 else f"trips {names[0]} to {names[-1]}"
        return f"mission {quoted(self.mission.name)}, {trips}"


def problems(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, airspace: Airspace
) -> list[str]:
    """Return a sentence for each trip that no drone of the fleet could ever do."""
    return [f"{one.called}: {one.reason}" for one in unflyable(missions, app, fleet, airspace)]


def unflyable(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, airspace: Airspace
) -> list[Unflyable]:
    """Return the trips that no drone of the fleet could ever do, each with the reason."""
    categories = {category.name: category for category in app.categories}
    drones = [(categories[drone.category], drone.home) for drone in fleet.drones]
    homes: dict[str, list[Point]] = {}
    for category, home in drones:
        homes.setdefault(category.name, []).append(home)
    found = []
    for mission in missions:
        rest: Sequence[Trip] = mission.trips
        while rest:
            chain = chain_of(rest)
            rest = rest[len(chain) :]
            asked = [
                (categories[name], min(points, key=partial(dist, chain[0].target)))
                for name, points in homes.items()
            ]
            misses = _misses(app, airspace, asked, chain)
            if misses is not None and any(miss.lacks > Lacks.PAYLOAD for miss in misses):
                asked = drones  # another home may be better placed after all
                misses = _misses(app, airspace, asked, chain)
            if misses is not None:
                reason = _nobody(_nearest(misses, asked))
                found.append(Unflyable(mission=mission, trips=chain, reason=reason))
    return found


def idle_actions(app: App, fleet: FleetFile) -> list[str]:
    """Return a sentence for each action of the app that no drone of the fleet can do.

    No mission need ask for it, so that is no error; but who draws the next mission might.
    """
    there = {drone.category for drone in fleet.drones}
    found = []
    for action in app.actions:
        able = [category.name for category in app.categories if category.can(action)]
        if there.isdisjoint(able) and (able or action not in BUILT_IN):
            who = f"it has no {' and no '.join(able)}" if able else "no category of the app can"
            found.append(f"no drone of the fleet can {action}: {who}")
    return found


def endless(missions: Sequence[Mission[Any]], app: App) -> list[str]:
    """Return a sentence for each mission that repeats until it is stopped."""
    rounds = [
        field.name
        for field in app.fields
        if field.on is Entity.MISSION and field.type is FieldType.ROUNDS
    ]
    return [
        f"mission {quoted(mission.name)} repeats until it is stopped ({name} = true): "
        "say when with --until, such as --until 2h"
        for mission in missions
        for name in rounds
        if getattr(mission, name) is True
    ]


def _misses(
    app: App,
    airspace: Airspace,
    drones: Sequence[tuple[Category, Point]],
    chain: Sequence[Trip],
) -> list[Miss] | None:
    """Return what each drone lacks; None as soon as one lacks nothing."""
    misses = []
    for category, home in drones:
        miss = miss_of(app, airspace, category, home, chain)
        if miss is None:
            return None
        misses.append(miss)
    return misses


def _nearest(misses: Sequence[Miss], drones: Sequence[tuple[Category, Point]]) -> list[Miss]:
    """Keep each category's nearest miss, in the fleet's order."""
    best: dict[str, Miss] = {}
    for miss, (category, _) in zip(misses, drones, strict=True):
        known = best.get(category.name)
        if known is None or (-miss.lacks, miss.by) < (-known.lacks, known.by):
            best[category.name] = miss
    return list(best.values())


def _nobody(misses: Sequence[Miss]) -> str:
    reasons = dict.fromkeys(miss.reason for miss in misses)
    return "no drone of the fleet can do it: " + "; ".join(reasons)
