"""Candidate fleets: the first drones of each category in the fleet file, and more beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import dist, floor, inf
from typing import Any

from ..files.fleet import DroneEntry, FleetFile
from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.airspace import Airspace
from ..shared.domain.model import Mission, Point

Counts = tuple[int, ...]
"""How many drones of each category, in the order in which the fleet file first has them."""

ALONE = 1.0
"""Metres between docks where the fleet file has one drone."""

BESIDE = 0.2
"""Metres that docks are farther apart than drones must be."""

_AWAY = 0.3
"""Metres that new docks are away from walls and no-fly areas."""


@dataclass(frozen=True, kw_only=True)
class Stock:
    """The drones of a fleet file, in any number: it says of which categories, and where their homes are."""

    fleet: FleetFile
    missions: Sequence[Mission[Any]]
    most: int
    """How many drones there may be."""

    @cached_property
    def kinds(self) -> tuple[str, ...]:
        """The categories that the file has drones of."""
        return tuple(dict.fromkeys(drone.category for drone in self.fleet.drones))

    @cached_property
    def given(self) -> Counts:
        """How many the file has."""
        categories = [drone.category for drone in self.fleet.drones]
        return tuple(map(categories.count, self.kinds))

    @cached_property
    def drones(self) -> Mapping[str, Sequence[DroneEntry]]:
        """The drones that there can be, by category; as many as there is room for."""
        found = {
            kind: [drone for drone in self.fleet.drones if drone.category == kind]
            for kind in self.kinds
        }
        names = {drone.id for drone in self.fleet.drones}
        docks = _Docks(self.fleet, self.missions)
        growing = list(self.kinds)
        while growing:  # in turn: no category takes all the room
            for kind in tuple(growing):
                home = docks.next(kind) if len(found[kind]) < self.most else None
                if home is None:
                    growing.remove(kind)
                else:
                    id = next(_names(kind, len(found[kind]) + 1, names))
                    found[kind].append(DroneEntry(id=id, category=kind, home=home))
        return found

    def of(self, counts: Counts) -> FleetFile | None:
        """Return the fleet with so many drones of each category; None: there is no room for them."""
        if not 0 < sum(counts) <= self.most:
            return None
        wanted = dict(zip(self.kinds, counts, strict=True))
        if any(count > len(self.drones[kind]) for kind, count in wanted.items()):
            return None
        chosen = [drone for kind, count in wanted.items() for drone in self.drones[kind][:count]]
        known = {drone.id: place for place, drone in enumerate(self.fleet.drones)}
        chosen.sort(key=lambda drone: known.get(drone.id, inf))
        return replace(self.fleet, drones=tuple(chosen))

    @cached_property
    def largest(self) -> FleetFile:
        """The most drones, as many of each category; of the fleet file, if there is no room for them."""
        each = self.most // len(self.kinds)
        counts = tuple(min(each, len(self.drones[kind])) for kind in self.kinds)
        return self.of(counts) or self.fleet


def _names(kind: str, number: int, taken: set[str]) -> Iterator[str]:
    """Yield names that no drone has."""
    while True:
        if (name := f"{kind}{number}") not in taken:
            taken.add(name)
            yield name
        number += 1


class _Docks:
    """Free places to stand, nearest to the given homes first."""

    def __init__(self, fleet: FleetFile, missions: Sequence[Mission[Any]]) -> None:
        homes = [drone.home for drone in fleet.drones]
        self._step = max(_least_distance(homes), fleet.apart + BESIDE)
        self._taken = [*homes, *_landings(missions)]
        self._places = {
            drone.category: iter(_around(fleet, drone.category, self._step))
            for drone in fleet.drones
        }

    def next(self, kind: str) -> Point | None:
        """Take the next free place for a drone of this category; None: there is none left."""
        for place in self._places[kind]:
            if all(dist(place, other) >= self._step - 1e-6 for other in self._taken):
                self._taken.append(place)
                return place
        return None


def _least_distance(homes: Sequence[Point]) -> float:
    pairs = [dist(one, other) for i, one in enumerate(homes) for other in homes[:i]]
    return min(pairs, default=ALONE)


def _landings(missions: Sequence[Mission[Any]]) -> Iterator[Point]:
    """Yield where drones land away from home: with an item, or for one."""
    for mission in missions:
        for trip in mission.trips:
            if trip.action in (PICK, RELEASE):
                yield (*trip.target[:2], 0.0)


def _around(fleet: FleetFile, kind: str, step: float) -> list[Point]:
    """Return the permitted places of a grid through a category's first home, nearest to its homes first."""
    homes = [drone.home for drone in fleet.drones if drone.category == kind]
    space = fleet.airspace
    places = [
        (round(x, 3), round(y, 3), homes[0][2])
        for x in _line(homes[0][0], step, space.size[0])
        for y in _line(homes[0][1], step, space.size[1])
    ]
    free = [place for place in places if _is_permitted(space, place)]
    return sorted(
        free, key=lambda place: (min(dist(place, home) for home in homes), place[1], place[0])
    )


def _line(through: float, step: float, end: float) -> list[float]:
    first = through - floor(through / step) * step
    return [first + i * step for i in range(floor((end - first) / step + 1e-9) + 1)]


def _is_permitted(space: Airspace, place: Point) -> bool:
    x, y, z = place
    beside = [(x + dx, y + dy, z) for dx in (-_AWAY, _AWAY) for dy in (-_AWAY, _AWAY)]
    return not any(map(space.problem, [place, *beside]))
