"""`nearest`: the free drone that is closest to where the trip begins."""

from __future__ import annotations

from math import dist
from typing import TYPE_CHECKING

from .ordered import Ordered

if TYPE_CHECKING:
    from ..model import Drone, Trip
    from ..policy import Pool


def nearest() -> Pool:
    """Give each trip, in turn, the closest free drone."""
    return Ordered(_away, _why)


def _away(drone: Drone, trip: Trip) -> float:
    return dist(drone.location, trip.source or trip.target)


def _why(free: int, away: float) -> str:
    return f"nearest of {free} free: {away:.1f} m away"
