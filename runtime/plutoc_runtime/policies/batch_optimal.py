"""`batch_optimal`: all waiting trips and all free drones at once, least total distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from .assignment import assign
from .grid import FEW, Places

if TYPE_CHECKING:
    from ..model import Drone, Point, Trip
    from ..policy import Able, BatchPool, Choice


_SOME = 16
"""It takes more drones than these that squares for the goals are worth their making."""


def batch_optimal() -> BatchPool:
    """Share the free drones out so that their way to all trips together is shortest."""
    return Batch()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Offer:
    """A trip that waits."""

    index: int
    goal: Point
    able: Able


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
        waiting = [
            _Offer(index=index, goal=trip.source or trip.target, able=able)
            for index, (trip, able) in enumerate(offers)
        ]
        if len(waiting) <= len(self._places):
            pairs = assign([self._drones_for(offer) for offer in waiting])
        else:
            pairs = self._from_the_drones(waiting)
        among = len(waiting), len(self._places)
        return [pair and (pair[1], partial(_why, *among, pair[0])) for pair in pairs]

    def _drones_for(self, offer: _Offer) -> Iterator[tuple[float, Drone]]:
        """Give the drones that are able to fly a trip, the closest first."""
        return (pair for pair in self._places.outward(offer.goal) if offer.able(pair[1]))

    def _from_the_drones(self, waiting: Sequence[_Offer]) -> list[tuple[float, Drone] | None]:
        """Give each drone a trip: there are more trips than drones."""
        drones = sorted(self._places, key=lambda drone: drone.index)
        goals: Places[_Offer] = Places(FEW if len(drones) > _SOME else len(waiting))
        for offer in waiting:
            goals.add(offer, offer.goal)
        pairs = assign([_trips_for(drone, goals) for drone in drones])
        shared: list[tuple[float, Drone] | None] = [None] * len(waiting)
        for drone, pair in zip(drones, pairs, strict=True):
            if pair is not None:
                away, offer = pair
                shared[offer.index] = away, drone
        return shared


def _why(waiting: int, free: int, away: float) -> str:
    return f"least total way for {waiting} waiting trips and {free} free drones: {away:.1f} m away"


def _trips_for(drone: Drone, goals: Places[_Offer]) -> Iterator[tuple[float, _Offer]]:
    """Give the trips that a drone is able to fly, the closest first."""
    return (pair for pair in goals.outward(drone.location) if pair[1].able(drone))
