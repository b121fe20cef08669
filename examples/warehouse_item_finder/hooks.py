"""How the app chooses who carries what."""

from __future__ import annotations

from collections.abc import Sequence

from . import Drone, Trip


def weakest_first(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
    """Choose the weakest of the drones that can carry the item, and of those the nearest.

    Candidates are free, strong enough for the item, and have the battery for all of it: the way
    to the shelf, to the desk and home. Equals are told apart by their place in the fleet file, so
    that the same missions always fly the same way.
    """
    start = trip.source or trip.target
    return min(
        candidates,
        key=lambda drone: (drone.category.payload, drone.distance(start), drone.index),
    )
