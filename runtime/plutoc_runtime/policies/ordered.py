"""Free drones in an order that does not change while they are free: a heap finds the first."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

from ..policy import Able, Choice

if TYPE_CHECKING:
    from ..model import Drone, Trip

Rank = int
"""What drones are compared by: the lowest is first. Its last digits are the place in the fleet."""

PLACE = (1 << 32) - 1
"""The digits of a rank that are a drone's place in the fleet: no two have the same."""

_SLACK = 64
"""Ranks of drones that are gone are dropped when there are so many, and as many as others."""


class Ordered:
    """A pool that gives each trip the first able drone by rank."""

    def __init__(self, rank: Callable[[Drone], Rank], why: Callable[[int, Rank], str]) -> None:
        self._rank, self._why = rank, why
        self._ranks: list[Rank] = []
        """A heap; what is in it of drones that are gone is dropped when it comes up."""
        self._free: list[Drone | None] = []
        """Those that are free, each at its place in the fleet."""
        self._count = 0
        self._most = _SLACK
        self._chosen = 0
        """The rank of whom was chosen last."""
        self._say_why = self._why_chosen

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        rank, ranks = self._rank(drone), self._ranks
        try:
            self._free[rank & PLACE] = drone
        except IndexError:
            self._free += [None] * (1 + (rank & PLACE) - len(self._free))
            self._free[rank & PLACE] = drone
        self._count += 1
        heappush(ranks, rank)
        if len(ranks) > self._most:
            self._tidy()

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        rank, ranks = self._rank(drone), self._ranks
        self._free[rank & PLACE] = None
        self._count -= 1
        if ranks and ranks[0] == rank:
            heappop(ranks)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the first drone that is able."""
        ranks = self._ranks
        while ranks:
            rank = ranks[0]
            drone = self._free[rank & PLACE]
            if drone is None or self._rank(drone) != rank:
                heappop(ranks)
            elif able(drone):
                self._chosen = rank
                return drone, self._say_why
            else:
                return self._next(able)
        return None

    def _next(self, able: Able) -> Choice | None:
        """Return the first able drone behind one that is not."""
        for rank in sorted(self._ranks):
            drone = self._free[rank & PLACE]
            if drone is not None and self._rank(drone) == rank and able(drone):
                self._chosen = rank
                return drone, self._say_why
        return None

    def _why_chosen(self) -> str:
        return self._why(self._count, self._chosen)

    def _tidy(self) -> None:
        self._ranks = [self._rank(drone) for drone in self._free if drone is not None]
        heapify(self._ranks)
        self._most = 2 * len(self._ranks) + _SLACK
