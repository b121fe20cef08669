"""`first`: the free drone that stands first in the fleet file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ..policy import Decision, Offer, one_by_one

if TYPE_CHECKING:
    from ..model import Drone, Trip


def first(offers: Iterable[Offer]) -> Iterator[Decision]:
    """Give each trip, in turn, the first free drone of the fleet."""
    return one_by_one(offers, _lowest)


def _lowest(trip: Trip, drones: Sequence[Drone]) -> tuple[Drone, str]:
    drone = min(drones, key=lambda drone: drone.index)
    return drone, f"first of {len(drones)} free in the fleet's order"
