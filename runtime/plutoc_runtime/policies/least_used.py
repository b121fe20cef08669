"""`least_used`: the free drone that has flown the fewest trips."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING

from .ordered import Ordered, Rank

if TYPE_CHECKING:
    from ..policy import Pool


def least_used() -> Pool:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    return Ordered(attrgetter("trips", "index"), _why)


def _why(free: int, rank: Rank) -> str:
    return f"least used of {free} free: {rank[0]} trips so far"
