"""Free drones in an order that does not change while they are free: a heap finds the first."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

from ..policy import Able, Choice

if TYPE_CHECKING:
    from ..model import Drone, Trip

Rank = tuple[int, int]
"""Drones of a lower rank come first; no two have the same."""

_SLACK = 64
"""Entries of drones that are gone are dropped when they are so many more than those that stay."""


class Ordered:
    """A pool that gives each trip the first able drone by rank."""

    def __init__(self, rank: Callable[[Drone], Rank], why: Callable[[Drone, int], str]) -> None:
        self._rank, self._why = rank, why
        self._heap: list[tuple[Rank, Drone]] = []
        self._free: dict[Drone, Rank] = {}

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        rank = self._free[drone] = self._rank(drone)
        heappush(self._heap, (rank, drone))

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more; its entry is dropped when it comes up."""
        self._free.pop(drone, None)
        if len(self._heap) > 2 * len(self._free) + _SLACK:
            self._heap = [(rank, drone) for drone, rank in self._free.items()]
            heapify(self._heap)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the first drone that is able; those before it stay."""
        heap, free = self._heap, self._free
        passed: list[tuple[Rank, Drone]] = []
        found: Choice | None = None
        while heap and found is None:
            entry = heap[0]
            rank, drone = entry
            if free.get(drone) is not rank:
                heappop(heap)  # it has been given away since
            elif able(drone):
                found = drone, self._why(drone, len(free))
            else:
                passed.append(heappop(heap))
        for entry in passed:
            heappush(heap, entry)
        return found
