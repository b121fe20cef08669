"""`least_used`: the free drone that has flown the fewest trips."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from . import lowest

if TYPE_CHECKING:
    from ...domain.model import Drone, Trip
    from . import Able, Choice


def least_used(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    found = lowest(free, able, lambda drone: drone.trips)
    return found and (found[0], f"least used of {len(free)} free: {found[1]} trips so far")
