"""A bare event loop: a heap of times and calls, and an event for each part of a flight."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from heapq import heappop, heappush
from math import inf

from .physics import ACTS, DOWN, UP, Drone, Fleet, Place, Trip, flies, main


class Loop:
    """The missions, each of which flies one trip after the other, and the time."""

    def __init__(self, plan: Sequence[Sequence[Place]], fleet: Fleet) -> None:
        self.now, self.ended, self._count = 0.0, 0.0, 0
        self._again = inf
        """When a drone that charges in its dock suffices."""
        self._plan, self._fleet, self._done = plan, fleet, [0] * len(plan)
        self._heap: list[tuple[float, int, Callable[[], None]]] = []

    def run(self) -> float:
        """Fly everything; return when the last trip ended."""
        self._fleet.waiting.extend((number, trips[0]) for number, trips in enumerate(self._plan))
        self._share_out()
        while self._heap:
            self.now, _, call = heappop(self._heap)
            call()
        return self.ended

    def _at(self, when: float, call: Callable[[], None]) -> None:
        self._count += 1
        heappush(self._heap, (when, self._count, call))

    def _share_out(self) -> None:
        fleet = self._fleet
        self._again = inf
        while (found := fleet.next(self.now)) is not None:
            self._at(self.now + UP, partial(self._goes, *found, self.now))
        if fleet.waiting and fleet.free:
            self._again = again = fleet.charges_until(self.now) + 0.001
            self._at(again, partial(self._look_again, again))

    def _look_again(self, when: float) -> None:
        if when == self._again:  # else it is known better by now
            self._share_out()

    def _goes(self, trip: Trip, drone: Drone, began: float) -> None:
        when = self.now + flies(drone.home, trip[1])
        self._at(when, partial(self._acts, trip, drone, began))

    def _acts(self, trip: Trip, drone: Drone, began: float) -> None:
        self._at(self.now + ACTS, partial(self._returns, trip, drone, began))

    def _returns(self, trip: Trip, drone: Drone, began: float) -> None:
        number, target = trip
        self.ended = self.now
        self._done[number] += 1
        if self._done[number] < len(self._plan[number]):
            self._fleet.waiting.append((number, self._plan[number][self._done[number]]))
            self._share_out()
        self._at(self.now + flies(target, drone.home), partial(self._lands, drone, began))

    def _lands(self, drone: Drone, began: float) -> None:
        self._at(self.now + DOWN, partial(self._is_down, drone, began))

    def _is_down(self, drone: Drone, began: float) -> None:
        drone.lands(self.now, self.now - began)
        self._fleet.free.append(drone)
        self._share_out()


def fly(plan: Sequence[Sequence[Place]], fleet: Fleet) -> float:
    """Fly a plan; return when the last trip ended."""
    return Loop(plan, fleet).run()


if __name__ == "__main__":
    main(fly)
