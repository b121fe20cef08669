"""The free drones, and the first able one by some rank: each is looked at."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING

from ..policy import Able, Choice, FreeDrones

if TYPE_CHECKING:
    from ..model import Drone, Trip

Rank = Callable[["Drone", "Trip"], float]
"""What drones are compared by for a trip: the lowest is first."""


class Ordered(FreeDrones):
    """A pool that gives each trip the able drone of the lowest rank; of equals, the fleet's first."""

    def __init__(self, rank: Rank, why: Callable[[int, float], str]) -> None:
        super().__init__()
        self._rank, self._why = rank, why

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the first drone that is able."""
        least = inf
        found: Drone | None = None
        for drone in self.free:
            rank = self._rank(drone, trip)
            better = rank < least or (rank == least and found and drone.index < found.index)
            if better and able(drone):
                least, found = rank, drone
        if found is None:
            return None
        return found, lambda: self._why(len(self.free), least)
