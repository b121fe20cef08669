"""`first`: the free drone that stands first in the fleet file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...domain.model import Drone, Trip
    from . import Able, Choice


def first(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the first free drone of the fleet."""
    drone = next(filter(able, free), None)
    return None if drone is None else (drone, f"first of {len(free)} free in the fleet's order")
