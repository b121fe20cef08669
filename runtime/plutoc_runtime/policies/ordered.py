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
"""What drones are compared by: the lowest is first; no two that are free have the same."""

_SLACK = 64
"""Ranks of drones that are gone are dropped when there are so many, and as many as others."""


class Ordered:
    """A pool that gives each trip the first able drone by rank."""

    def __init__(self, rank: Callable[[Drone], Rank], why: Callable[[int, Rank], str]) -> None:
        self._rank, self._why = rank, why
        self._ranks: list[Rank] = []
        """A heap; what is in it of drones that are gone is dropped when it comes up."""
        self._free: dict[Rank, Drone] = {}
        self._most = _SLACK

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        rank = self._rank(drone)
        self._free[rank] = drone
        heappush(self._ranks, rank)
        if len(self._ranks) > self._most:
            self._tidy()

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        rank, ranks = self._rank(drone), self._ranks
        self._free.pop(rank, None)
        if ranks and ranks[0] == rank:
            heappop(ranks)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the first drone that is able."""
        ranks, free = self._ranks, self._free
        while ranks:
            rank = ranks[0]
            drone = free.get(rank)
            if drone is None:
                heappop(ranks)
            elif able(drone):
                return drone, partial(self._why, len(free), rank)
            else:
                return self._next(able)
        return None

    def _next(self, able: Able) -> Choice | None:
        """Return the first able drone behind one that is not."""
        for rank in sorted(self._free):
            if able(self._free[rank]):
                return self._free[rank], partial(self._why, len(self._free), rank)
        return None

    def _tidy(self) -> None:
        self._ranks = list(self._free)
        heapify(self._ranks)
        self._most = 2 * len(self._ranks) + _SLACK
