"""Allocation policies: what one is, and those that choose a drone for trip after trip."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..domain.model import Drone, Trip

Able = Callable[["Drone"], bool]
"""Returns whether a drone can fly the trip now. It may search a route: call it for few drones."""

Choice = tuple["Drone", str]  # the drone that gets a trip, and why it was chosen

OneByOne = Callable[["Trip", Sequence["Drone"], Able], Choice | None]
"""Chooses one of the free drones, in the fleet's order, for a trip, or None."""

Policy = Callable[..., Any]  # such a one, or a `Batch`, which chooses for all that wait


def lowest(
    free: Sequence[Drone], able: Able, rank: Callable[[Drone], float]
) -> tuple[Drone, float] | None:
    """Return the able drone of the lowest rank, and that rank; of equals, the fleet's first."""
    for drone in sorted(free, key=rank):
        if able(drone):
            return drone, rank(drone)
    return None


def nearest(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the closest free drone."""
    goal = trip.source or trip.target
    found = lowest(free, able, lambda drone: drone.distance(goal))
    return found and (found[0], f"nearest of {len(free)} free: {found[1]:.1f} m away")


def first(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the first free drone of the fleet."""
    drone = next(filter(able, free), None)
    return None if drone is None else (drone, f"first of {len(free)} free in the fleet's order")


def least_used(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
    """Give each trip, in turn, the free drone with the fewest trips behind it."""
    found = lowest(free, able, lambda drone: drone.trips)
    return found and (found[0], f"least used of {len(free)} free: {found[1]} trips so far")
