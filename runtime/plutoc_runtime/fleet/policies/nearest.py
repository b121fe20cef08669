"""`nearest`: the free drone that is closest to where the trip begins."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from . import lowest

if TYPE_CHECKING:
    from ...domain.model import Drone, Trip
    from . import Able, Choice


def nearest(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the closest free drone."""
    goal = trip.source or trip.target
    found = lowest(free, able, lambda drone: drone.distance(goal))
    return found and (found[0], f"nearest of {len(free)} free: {found[1]:.1f} m away")
