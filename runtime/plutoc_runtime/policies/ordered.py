"""The free drones, and the first able one by some rank: each is looked at."""

from __future__ import annotations

from collections.abc import Callable
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
        ranked = [
            (self._rank(drone, trip), drone.index, drone) for drone in self.free if able(drone)
        ]
        if not ranked:
            return None
        rank, _, drone = min(ranked)
        return drone, lambda: self._why(len(self.free), rank)
