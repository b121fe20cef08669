"""Who of those that wait can be served with what is in a drone's battery, found fast.

For a drone that was too low for somebody, all who wait are kept by the level that they ask for where
the drone stands, the least first. A drone that charges between its flights is often high enough for
one of a thousand: nobody else is looked at.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heapify, heappop, heappush
from math import inf
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

if TYPE_CHECKING:
    from .model import Drone, Point

_SLACK = 64
"""Entries of those who wait no more are dropped when there are so many, and as many as others."""


class Asking(Protocol):
    """Somebody who waits for a drone."""

    @property
    def waits(self) -> bool:
        """Whether a drone is still wanted."""
        ...

    def level(self, drone: Drone) -> float:
        """Return what it takes in the battery; infinite: no battery is enough."""
        ...


A = TypeVar("A", bound=Asking)


class Thresholds(Generic[A]):
    """Those who wait, by what they ask of a drone.

    They come as the queue keeps them: where they stand in it, and who it is. Those who wait no more
    may be among them.
    """

    def __init__(self) -> None:
        self.kept: dict[Drone, _Asked[A]] = {}
        """What is known of each drone that was too low; to be cleared when nobody waits."""

    def add(self, entry: tuple[int, int, A]) -> None:
        """Somebody has come."""
        for asked in self.kept.values():
            asked.add(entry)

    def least(self, drone: Drone, waiting: Iterable[tuple[int, int, A]]) -> float:
        """Return the lowest level that somebody asks of a drone where it stands."""
        heap = self._asked(drone, waiting).heap
        while heap and not heap[0][1][2].waits:
            heappop(heap)
        return heap[0][0] if heap else inf

    def met(
        self, drone: Drone, waiting: Iterable[tuple[int, int, A]]
    ) -> Iterator[tuple[int, int, A]]:
        """Give those who ask for no more than the drone has, in any order."""
        heap, level = self._asked(drone, waiting).heap, drone.battery_level
        indices = [0]
        for index in indices:  # a heap: those at 2n + 1 and 2n + 2 ask for no less than that at n
            if index < len(heap) and heap[index][0] <= level:
                indices += (2 * index + 1, 2 * index + 2)
                if heap[index][1][2].waits:
                    yield heap[index][1]

    def _asked(self, drone: Drone, waiting: Iterable[tuple[int, int, A]]) -> _Asked[A]:
        asked, here = self.kept.get(drone), drone.location
        if asked is None or asked.here != here:
            asked = self.kept[drone] = _Asked(here, list(waiting))
        asked.settle(drone)
        return asked


class _Asked(Generic[A]):
    """What is asked of one drone at one place."""

    __slots__ = ("_most", "_new", "heap", "here")

    def __init__(self, here: Point, new: list[tuple[int, int, A]]) -> None:
        self.here, self._new = here, new
        self.heap: list[tuple[float, tuple[int, int, A]]] = []
        self._most = len(new) + _SLACK

    def add(self, entry: tuple[int, int, A]) -> None:
        """Somebody has come; what is asked for is found out when it matters."""
        self._new.append(entry)
        if len(self._new) > self._most:
            self._new = [entry for entry in self._new if entry[2].waits]
            self._most = 2 * len(self._new) + _SLACK

    def settle(self, drone: Drone) -> None:
        """Take in those who have come."""
        new, self._new = self._new, []
        for entry in new:
            level = entry[2].level(drone) if entry[2].waits else inf
            if level < inf:
                heappush(self.heap, (level, entry))
        if len(self.heap) > self._most:
            self.heap = [kept for kept in self.heap if kept[1][2].waits]
            heapify(self.heap)
            self._most = 2 * len(self.heap) + _SLACK
