"""The same with SimPy: a process a mission, another a way home, and a time-out for each part of a flight."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from math import inf
from typing import Any

import simpy

from .physics import ACTS, DOWN, UP, Drone, Fleet, Place, flies, main

Way = Generator[Any, Any, None]


class World:
    """The missions and the drones, as processes."""

    def __init__(self, fleet: Fleet) -> None:
        self.env, self.ended, self._fleet = simpy.Environment(), 0.0, fleet
        self._again = inf
        """When a drone that charges in its dock suffices."""
        self._asked: dict[int, simpy.Event] = {}
        """What each mission that waits for a drone waits for."""

    def mission(self, number: int, trips: Sequence[Place]) -> Way:
        """Fly one trip after the other."""
        env = self.env
        for target in trips:
            self._asked[number] = asked = env.event()
            self._fleet.waiting.append((number, target))
            self._share_out()
            drone = yield asked
            began = env.now
            yield env.timeout(UP)
            yield env.timeout(flies(drone.home, target))
            yield env.timeout(ACTS)
            self.ended = env.now
            env.process(self._home(drone, target, began))

    def _home(self, drone: Drone, start: Place, began: float) -> Way:
        yield self.env.timeout(flies(start, drone.home))
        yield self.env.timeout(DOWN)
        drone.lands(self.env.now, self.env.now - began)
        self._fleet.free.append(drone)
        self._share_out()

    def _share_out(self) -> None:
        fleet, now = self._fleet, self.env.now
        self._again = inf
        while (found := fleet.next(now)) is not None:
            (number, _), drone = found
            self._asked.pop(number).succeed(drone)
        if fleet.waiting and fleet.free:
            self._again = again = fleet.charges_until(now) + 0.001
            self.env.process(self._charged(again, again - now))

    def _charged(self, when: float, seconds: float) -> Way:
        yield self.env.timeout(seconds)
        if when == self._again:  # else it is known better by now
            self._share_out()


def fly(plan: Sequence[Sequence[Place]], fleet: Fleet) -> float:
    """Fly a plan; return when the last trip ended."""
    world = World(fleet)
    for number, trips in enumerate(plan):
        world.env.process(world.mission(number, trips))
    world.env.run()
    return world.ended


if __name__ == "__main__":
    main(fly)
