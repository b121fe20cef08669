"""Trips, docks and drones, and how long each part of a flight takes: the motion model of the library."""

from __future__ import annotations

import argparse
import json
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import dist, hypot
from random import Random

from plutoc_runtime.domain.actions import BUILT_IN
from plutoc_runtime.domain.motion import CRAZYFLIE, charged, charging

Place = tuple[float, float]
Trip = tuple[int, Place]
"""The number of its mission, and its target."""

SIDE, PER_MISSION, CRUISE = 40.0, 5, 1.2
"""The map in metres, trips to a mission, and the height of all flights."""
SPEED, FLIGHT_TIME, CHARGE_TIME, RESERVE = 1.0, 420.0, 1200.0, 0.2
ACTS = BUILT_IN["take_photo"].seconds
UP = CRAZYFLIE.rises(CRUISE, SPEED)
DOWN = CRAZYFLIE.lands(CRUISE, SPEED)


def targets(trips: int) -> list[Place]:
    """Return where to fly, in the order of the plan."""
    chance = Random(1)
    far = SIDE - 1
    return [
        (round(chance.uniform(1, far), 2), round(chance.uniform(1, far), 2)) for _ in range(trips)
    ]


def homes(drones: int) -> list[Place]:
    """Return docks in rows in the middle of the map."""
    return [
        (round(SIDE / 2 - 4 + number % 10 * 0.9, 2), round(SIDE / 2 - 2 + number // 10 * 0.9, 2))
        for number in range(drones)
    ]


def flies(a: Place, b: Place) -> float:
    """Return the seconds of a leg."""
    return CRAZYFLIE.flies(dist(a, b), SPEED)


@dataclass(slots=True, eq=False)
class Drone:
    """A drone, and its battery as it was when it landed."""

    home: Place
    level: float = 1.0
    since: float = 0.0

    def level_at(self, now: float) -> float:
        """Return its level after charging in its dock."""
        return charged(self.level, now - self.since, CHARGE_TIME, CRAZYFLIE.taper)

    def needs(self, target: Place) -> float:
        """Return the level that a trip from its dock takes, with the reserve."""
        x, y = target
        seconds = UP + 2 * CRAZYFLIE.flies(hypot(x - self.home[0], y - self.home[1]), SPEED)
        return RESERVE + (seconds + ACTS + DOWN) / FLIGHT_TIME

    def lands(self, now: float, flown: float) -> None:
        """Note that it is back in its dock after so many seconds in the air."""
        self.level -= flown / FLIGHT_TIME
        self.since = now


@dataclass(slots=True, eq=False)
class Fleet:
    """The drones in their docks, and the trips that wait for one: first come, first served."""

    free: list[Drone]
    waiting: deque[Trip] = field(default_factory=deque)

    def next(self, now: float) -> tuple[Trip, Drone] | None:
        """Take the first trip and the nearest drone whose battery suffices for it, if there is one."""
        if not self.waiting:
            return None
        target, best, least = self.waiting[0][1], None, 0.0
        for drone in self.free:
            away = dist(drone.home, target)
            if (best is None or away < least) and drone.level_at(now) >= drone.needs(target):
                best, least = drone, away
        if best is None:
            return None
        self.free.remove(best)
        best.level = best.level_at(now)
        return self.waiting.popleft(), best

    def charges_until(self, now: float) -> float:
        """Return when a drone in its dock suffices for the first trip at the earliest."""
        target = self.waiting[0][1]
        return now + min(
            charging(drone.level_at(now), drone.needs(target), CHARGE_TIME, CRAZYFLIE.taper)
            for drone in self.free
        )


def main(fly: Callable[[Sequence[Sequence[Place]], Fleet], float]) -> None:
    """Fly as many trips with as many drones as the command line says; print when the last has ended."""
    parser = argparse.ArgumentParser()
    parser.add_argument("trips", type=int)
    parser.add_argument("drones", type=int)
    given = parser.parse_args()
    goals = targets(given.trips)
    plan = [goals[start : start + PER_MISSION] for start in range(0, len(goals), PER_MISSION)]
    fleet = Fleet([Drone(home) for home in homes(given.drones)])
    print(json.dumps({"duration_s": fly(plan, fleet), "trips": {"completed": given.trips}}))
