"""Could the fleet ever do what the missions ask? Asked before anything flies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from .actions import PICK, RELEASE
from .airspace import Airspace
from .app import App
from .energy import CLIMB_SPEED, needed
from .fields import Entity, FieldType
from .model import Category, Mission, Point, Trip
from .words import mass, percent, place, quoted

if TYPE_CHECKING:
    from .files.fleet import FleetFile


class _Lacks(IntEnum):
    """What a drone lacks for a trip, the farthest from doing it first."""

    ACTION = 0
    PAYLOAD = 1
    WAY = 2
    ENERGY = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class _Miss:
    lacks: _Lacks
    by: float
    """How much is lacking: of two alike the smaller is nearer."""
    reason: str


def chain_of(trips: Sequence[Trip]) -> Sequence[Trip]:
    """Return the trips that one drone must fly: the first, and from a pick all to its release."""
    if trips and trips[0].action == PICK:
        for place_, trip in enumerate(trips):
            if trip.action == RELEASE and place_ > 0:
                return trips[: place_ + 1]
        return trips
    return trips[:1]


def why_not(
    app: App, airspace: Airspace, category: Category, home: Point, chain: Sequence[Trip]
) -> str | None:
    """Return why a drone of this category and home can never fly the chain; None: it can."""
    miss = _miss(app, airspace, category, home, chain)
    return miss.reason if miss else None


def problems(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, airspace: Airspace
) -> list[str]:
    """Return a sentence for each trip that no drone of the fleet could ever do."""
    categories = {category.name: category for category in app.categories}
    drones = [(categories[drone.category], drone.home) for drone in fleet.drones]
    found = []
    for mission in missions:
        rest: Sequence[Trip] = mission.trips
        while rest:
            chain = chain_of(rest)
            rest = rest[len(chain) :]
            misses = _misses(app, airspace, drones, chain)
            if misses is not None:
                found.append(f"{_called(mission, chain)}: {_nobody(_nearest(misses, drones))}")
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
) -> list[_Miss] | None:
    """Return what each drone lacks; None as soon as one lacks nothing."""
    misses = []
    for category, home in drones:
        miss = _miss(app, airspace, category, home, chain)
        if miss is None:
            return None
        misses.append(miss)
    return misses


def _miss(
    app: App, airspace: Airspace, category: Category, home: Point, chain: Sequence[Trip]
) -> _Miss | None:
    for trip in chain:
        if not category.can(trip.action):
            return _Miss(
                lacks=_Lacks.ACTION, by=0.0, reason=f"{category.name} cannot {trip.action}"
            )
    for trip in chain:
        if trip.item is not None and trip.item.mass > category.payload:
            return _too_heavy(category, trip.item.mass)
    stops = stops_of(app, airspace, chain)
    share = needed(category, airspace, home, stops, home)
    if share is None:
        return _no_way(category, airspace, home, stops)
    if share + category.reserve > 1:
        return _too_far(category, home, share)
    return None


def stops_of(app: App, airspace: Airspace, chain: Sequence[Trip]) -> list[tuple[Point, float]]:
    """Return where a chain leads, with the seconds that the drone is busy there.

    Between two trips of a chain it lands with its item, and rises again.
    """
    stops: list[tuple[Point, float]] = []
    for place_, trip in enumerate(chain, start=1):
        if trip.source is not None:
            stops.append((trip.source, 0.0))
        busy = app.actions[trip.action].seconds
        if place_ < len(chain):
            busy += (trip.target[2] + airspace.cruise_height) / CLIMB_SPEED
        stops.append((trip.target, busy))
    return stops


def _too_heavy(category: Category, weight: float) -> _Miss:
    return _Miss(
        lacks=_Lacks.PAYLOAD,
        by=weight - category.payload,
        reason=f"{category.name} carries at most {mass(category.payload)}, "
        f"the item weighs {mass(weight)}",
    )


def _no_way(
    category: Category, airspace: Airspace, home: Point, stops: Sequence[tuple[Point, float]]
) -> _Miss:
    here = home
    for point, _ in [*stops, (home, 0.0)]:
        if airspace.route(here, point) is None:
            break
        here = point
    return _Miss(
        lacks=_Lacks.WAY,
        by=0.0,
        reason=f"{category.name} finds no permitted way from {place(here)} to {place(point)}",
    )


def _too_far(category: Category, home: Point, share: float) -> _Miss:
    return _Miss(
        lacks=_Lacks.ENERGY,
        by=share + category.reserve - 1,
        reason=f"{category.name} would need {percent(share)} of a full battery from its home "
        f"{place(home)} and back, and {percent(category.reserve)} must be left",
    )


def _nearest(misses: Sequence[_Miss], drones: Sequence[tuple[Category, Point]]) -> list[_Miss]:
    """Keep each category's nearest miss, in the fleet's order."""
    best: dict[str, _Miss] = {}
    for miss, (category, _) in zip(misses, drones, strict=True):
        known = best.get(category.name)
        if known is None or (-miss.lacks, miss.by) < (-known.lacks, known.by):
            best[category.name] = miss
    return list(best.values())


def _nobody(misses: Sequence[_Miss]) -> str:
    reasons = dict.fromkeys(miss.reason for miss in misses)
    return "no drone of the fleet can do it: " + "; ".join(reasons)


def _called(mission: Mission[Any], chain: Sequence[Trip]) -> str:
    names = [trip.name if trip.name.isdigit() else quoted(trip.name) for trip in chain]
    trips = f"trip {names[0]}" if len(names) == 1 else f"trips {names[0]} to {names[-1]}"
    return f"mission {quoted(mission.name)}, {trips}"
