"""Free drones in an order that does not change while they are free: a heap finds the first."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, Any

from ..policy import Able, Choice

if TYPE_CHECKING:
    from ..model import Drone, Trip

Rank = Any
"""What drones are compared by: of a lower rank is first; no two have the same."""


class Ordered:
    """A pool that gives each trip the first able drone by rank."""

    def __init__(self, rank: Callable[[Drone], Rank], why: Callable[[int, Rank], str]) -> None:
        self._rank, self._why = rank, why
        self._heap: list[tuple[Rank, Drone]] = []
        self._free: dict[Drone, Rank] = {}
        self._most = 64

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        self._free[drone] = rank = self._rank(drone)
        heappush(self._heap, (rank, drone))
        if len(self._heap) > self._most:
            self._tidy()

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more; its entry is dropped when it comes up."""
        self._free.pop(drone, None)
        heap = self._heap
        if heap and heap[0][1] is drone:
            heappop(heap)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the first drone that is able."""
        heap, free = self._heap, self._free
        while heap:
            rank, drone = heap[0]
            if free.get(drone) is rank:
                if able(drone):
                    return drone, partial(self._why, len(free), rank)
                return self._next(able)
            heappop(heap)  # it has been given away since
        return None

    def _next(self, able: Able) -> Choice | None:
        """Return the first able drone behind one that is not."""
        for drone, rank in sorted(self._free.items(), key=lambda pair: pair[1]):
            if able(drone):
                return drone, partial(self._why, len(self._free), rank)
        return None

    def _tidy(self) -> None:
        """Drop the entries of drones that are gone."""
        self._heap = [(rank, drone) for drone, rank in self._free.items()]
        heapify(self._heap)
        self._most = 64 + 2 * len(self._heap)
