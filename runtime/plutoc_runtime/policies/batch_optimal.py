"""`batch_optimal`: all waiting trips and all free drones at once, least total distance."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from heapq import heapify, heappop
from itertools import repeat
from math import dist
from typing import TYPE_CHECKING

from .assignment import assign
from .grid import Places

if TYPE_CHECKING:
    from ..model import Drone, Point, Trip
    from ..policy import Able, BatchPool, Choice


_SOME = 16
"""It takes more drones than these that squares for the goals are worth their making."""


def batch_optimal() -> BatchPool:
    """Share the free drones out so that their way to all trips together is shortest."""
    return Batch()


@dataclass(slots=True, eq=False)
class _Goal:
    """Where a trip begins that waits."""

    index: int


class Batch:
    """The free drones, and where they stand."""

    def __init__(self) -> None:
        self._places: Places[Drone] = Places()

    def add(self, drone: Drone) -> None:
        """A drone is free; it stays where it is while it is."""
        self._places.add(drone, drone.location)

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        self._places.remove(drone)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the drone for a trip that waits alone."""
        return self.share([(trip, able)])[0]

    def share(self, offers: Sequence[tuple[Trip, Able]]) -> Sequence[Choice | None]:
        """Return a drone, or None, for each trip: for as many as can be, and the way is shortest."""
        goals = [trip.source or trip.target for trip, _ in offers]
        if len(offers) <= len(self._places):
            waiting = zip(goals, offers, strict=True)
            pairs = assign([self._drones_for(goal, able) for goal, (_, able) in waiting])
        else:
            pairs = self._from_the_drones(goals, offers)
        among = len(offers), len(self._places)
        return [pair and (pair[1], partial(_why, *among, pair[0])) for pair in pairs]

    def _drones_for(self, goal: Point, able: Able) -> Iterator[tuple[float, Drone]]:
        """Give the drones that are able to fly a trip, the closest first."""
        return (pair for pair in self._places.outward(goal) if able(pair[1]))

    def _from_the_drones(
        self, goals: Sequence[Point], offers: Sequence[tuple[Trip, Able]]
    ) -> list[tuple[float, Drone] | None]:
        """Give each drone a trip: there are more trips than drones."""
        drones = sorted(self._places, key=lambda drone: drone.index)
        closest = _by_squares(goals) if len(drones) > _SOME else partial(_in_order, goals)

        def trips_for(drone: Drone) -> Iterator[tuple[float, int]]:
            return (pair for pair in closest(drone.location) if offers[pair[1]][1](drone))

        shared: list[tuple[float, Drone] | None] = [None] * len(offers)
        for drone, pair in zip(drones, assign([trips_for(drone) for drone in drones]), strict=True):
            if pair is not None:
                away, index = pair
                shared[index] = away, drone
        return shared


def _in_order(goals: Sequence[Point], place: Point) -> Iterator[tuple[float, int]]:
    """Give the distances and the numbers of all goals, the closest first."""
    found = list(zip(map(dist, goals, repeat(place)), range(len(goals)), strict=False))
    heapify(found)  # not sorted: often only the first few are wanted
    while found:
        yield heappop(found)


def _by_squares(goals: Sequence[Point]) -> Callable[[Point], Iterator[tuple[float, int]]]:
    """Return what does the same faster, once it has been made."""
    kept: Places[_Goal] = Places()
    for index, goal in enumerate(goals):
        kept.add(_Goal(index), goal)
    return lambda place: ((away, goal.index) for away, goal in kept.outward(place))


def _why(waiting: int, free: int, away: float) -> str:
    return f"least total way for {waiting} waiting trips and {free} free drones: {away:.1f} m away"
