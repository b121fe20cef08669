"""`least_used`: the free drone that has flown the fewest trips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .ordered import Ordered

if TYPE_CHECKING:
    from ..policy import Pool


def least_used() -> Pool:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    return Ordered(lambda drone, _: drone.trips, _why)


def _why(free: int, trips: float) -> str:
    return f"least used of {free} free: {trips} trips so far"
