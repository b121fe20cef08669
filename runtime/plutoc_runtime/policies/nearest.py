"""`nearest`: the free drone that is closest to where the trip begins."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ..policy import Decision, Offer, one_by_one

if TYPE_CHECKING:
    from ..model import Drone, Trip


def nearest(offers: Iterable[Offer]) -> Iterator[Decision]:
    """Give each trip, in turn, the closest free drone."""
    return one_by_one(offers, _closest)


def _closest(trip: Trip, drones: Sequence[Drone]) -> tuple[Drone, str]:
    goal = trip.source or trip.target
    drone = min(drones, key=lambda drone: (drone.distance(goal), drone.index))
    return drone, f"nearest of {len(drones)} free: {drone.distance(goal):.1f} m away"
