"""`least_used`: the free drone that has flown the fewest trips."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ..policy import Decision, Offer, one_by_one

if TYPE_CHECKING:
    from ..model import Drone, Trip


def least_used(offers: Iterable[Offer]) -> Iterator[Decision]:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    return one_by_one(offers, _freshest)


def _freshest(trip: Trip, drones: Sequence[Drone]) -> tuple[Drone, str]:
    drone = min(drones, key=lambda drone: (drone.trips, drone.index))
    return drone, f"least used of {len(drones)} free: {drone.trips} trips so far"
