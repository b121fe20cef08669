"""`batch_optimal`: all waiting trips and all free drones at once, least total distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from math import dist
from typing import TYPE_CHECKING

from ..policy import FreeDrones
from .assignment import assign

if TYPE_CHECKING:
    from ..model import Drone, Point, Trip
    from ..policy import Able, BatchPool, Choice


def batch_optimal() -> BatchPool:
    """Share the free drones out so that their way to all trips together is shortest."""
    return Batch()


class Batch(FreeDrones):
    """A pool that looks at all trips that wait."""

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the drone for a trip that waits alone."""
        return self.share([(trip, able)])[0]

    def share(self, offers: Sequence[tuple[Trip, Able]]) -> Sequence[Choice | None]:
        """Return a drone, or None, for each trip: for as many as can be, and the way is shortest."""
        goals = [trip.source or trip.target for trip, _ in offers]
        drones = sorted(self.free, key=lambda drone: drone.index)
        if len(offers) <= len(drones):
            waiting = zip(goals, offers, strict=True)
            pairs = assign([_drones_for(drones, goal, able) for goal, (_, able) in waiting])
        else:
            pairs = _from_the_drones(drones, goals, offers)
        among = len(offers), len(drones)
        return [pair and (pair[1], partial(_why, *among, pair[0])) for pair in pairs]


def _drones_for(drones: Sequence[Drone], goal: Point, able: Able) -> Iterator[tuple[float, Drone]]:
    """Give the drones that are able to fly a trip, the closest first."""
    away = sorted((dist(drone.location, goal), drone.index, drone) for drone in drones)
    return ((metres, drone) for metres, _, drone in away if able(drone))


def _from_the_drones(
    drones: Sequence[Drone], goals: Sequence[Point], offers: Sequence[tuple[Trip, Able]]
) -> list[tuple[float, Drone] | None]:
    """Give each drone a trip: there are more trips than drones."""

    def trips_for(drone: Drone) -> Iterator[tuple[float, int]]:
        away = sorted((dist(goal, drone.location), number) for number, goal in enumerate(goals))
        return (pair for pair in away if offers[pair[1]][1](drone))

    shared: list[tuple[float, Drone] | None] = [None] * len(offers)
    for drone, pair in zip(drones, assign([trips_for(drone) for drone in drones]), strict=True):
        if pair is not None:
            away, number = pair
            shared[number] = away, drone
    return shared


def _why(waiting: int, free: int, away: float) -> str:
    return f"least total way for {waiting} waiting trips and {free} free drones: {away:.1f} m away"
