"""`first`: the free drone that stands first in the fleet file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .ordered import Ordered

if TYPE_CHECKING:
    from ..policy import Pool


def first() -> Pool:
    """Give each trip, in turn, the first free drone of the fleet."""
    return Ordered(lambda drone, _: drone.index, _why)


def _why(free: int, _: float) -> str:
    return f"first of {free} free in the fleet's order"
