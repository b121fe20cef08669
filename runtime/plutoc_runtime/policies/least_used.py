"""`least_used`: the free drone that has flown the fewest trips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .ordered import PLACE, Ordered, Rank

if TYPE_CHECKING:
    from ..model import Drone
    from ..policy import Pool


def least_used() -> Pool:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    return Ordered(_rank, _why)


def _rank(drone: Drone) -> Rank:
    return drone.trips * (PLACE + 1) + drone.index


def _why(free: int, rank: Rank) -> str:
    return f"least used of {free} free: {rank // (PLACE + 1)} trips so far"
