"""Random fleets that fly at random, and eyes that see whether any two come too near."""

from __future__ import annotations

from collections.abc import Coroutine as Call
from itertools import combinations
from math import dist, inf
from random import Random
from typing import Any, TypeVar

from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.shared.domain.actions import PICK
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category, Item, Point
from pluto_fleet.shared.fleet.reach import docked
from pluto_fleet.shared.fleet.telemetry import resting
from pluto_fleet.shared.time.kernel import FLEET, EventKind, Future
from pluto_fleet.shared.time.kernel import Task as Coroutine
from tests.library.gateway.flights import Commander, Field, Task

T = TypeVar("T")

ENDURING = Category(name="enduring", speed=0.5, flight_time=1e6, charge_time=1.0)
"""A drone whose battery ends no wait for the others."""
GLANCE = 0.1
"""Seconds between two looks at all drones."""


class Sky(Field):
    """Simulated drones behind a gateway that keeps them apart, and what is seen of them."""

    def __init__(
        self,
        homes: list[tuple[float, float]],
        *,
        airspace: Airspace | None = None,
        apart: float = 0.5,
        category: Category = ENDURING,
        **options: Any,
    ) -> None:
        super().__init__(airspace=airspace, homes=homes, category=category, apart=apart, **options)
        self.apart = apart
        self.epoch = 1
        self.commander: Commander = self.link(self.epoch)
        self.nearest = inf
        """How near two drones in the air have come to each other; those that fail do not count."""
        self.airborne = 0
        """How many were in the air at once, at most."""
        self.trips = 0

    # What is seen

    def look(self) -> None:
        """See how near drones in the air are to each other."""
        bodies = self.navigation.bodies.values()
        at = [body.location for body in bodies if not body.landed and body.down is None]
        self.airborne = max(self.airborne, len(at))
        for a, b in combinations(at, 2):
            self.nearest = min(self.nearest, dist(a, b))

    def until(self, done: Future[Any], most: float) -> bool:
        """Let time pass, with open eyes; say whether it was done by then."""
        kernel, end = self.kernel, self.kernel.now + most
        while not done.is_set:
            if kernel.now >= end:
                return False
            self.advance(GLANCE)
            self.look()
        return True

    # What a brain does

    async def fly(self, drone: str, *stops: Point, item: Item | None = None) -> object:
        """Give a drone a job, and wait for what is reported; with an item it is picked, just there."""
        self.trips += 1
        over: Future[object] = Future()
        action = None if item is None else PICK
        job = Task(
            id=f"{self.trips}",
            drone=drone,
            stops=stops,
            action=action,
            item=item,
            beside=item is None,
        )
        self.commander.fly(job, over.set)
        return await over

    def gives(self, drone: str, *stops: Point, item: Item | None = None) -> Coroutine[object]:
        """Give a drone a job, as a brain does in the middle of other things."""
        job = self.fly(drone, *stops, item=item)
        return self.kernel.spawn(job, FLEET + 50, f"{drone} is given a job")

    def sends(self, command: Call[Any, Any, T]) -> Coroutine[T]:
        return self.kernel.spawn(command, FLEET, "a command")

    def at(self, drone: str) -> Point:
        return self.navigation.telemetry[drone].location

    async def goes_home(self, drone: str) -> None:
        """Let a drone return as the fleet does it."""
        try:
            await self.commander.home(drone)
        except FlightFailed:
            await self.commander.recover(drone)

    def puts(self, *places: Point) -> None:
        """Let the drones hover at these places, before a gateway that has not seen them take off."""
        for drone, there in zip(self.drones, places, strict=True):
            self.put(drone.id, there)
        self.another()
        self.commander = self.link(self.epoch)

    def put(self, drone: str, place: Point) -> None:
        """Let a drone hover at a place, or lie on the ground there."""
        body, now = self.navigation.bodies[drone], self.kernel.now
        body.follow([place])
        body.turn([resting(place, now)], now)

    async def pause(self, seconds: float) -> None:
        await self.kernel.sleep(seconds, EventKind.CLOCK, FLEET)


class Restless:
    """Flies each drone of a sky a number of times, and lets things happen to it meanwhile."""

    def __init__(
        self, sky: Sky, seed: int, targets: list[Point], trips: int, mishaps: float
    ) -> None:
        self.sky, self.chance = sky, Random(seed)
        self.targets, self.trips, self.mishaps = targets, trips, mishaps

    def begin(self) -> list[Coroutine[None]]:
        spawn = self.sky.kernel.spawn
        return [
            spawn(self._one(drone.id), FLEET + 100 + drone.index, f"{drone.id} is restless")
            for drone in self.sky.drones
        ]

    async def _one(self, drone: str) -> None:
        chance = self.chance
        link = self.sky.commander
        for _ in range(self.trips):
            await self.sky.pause(chance.choice([0.0, 0.0, 1.0, 7.0]))
            stops = chance.choices(self.targets, k=chance.choice([1, 1, 2]))
            happens = chance.random() < self.mishaps
            if happens:
                self.sky.kernel.at(
                    self.sky.kernel.now + chance.uniform(0.5, 30),
                    EventKind.CLOCK,
                    FLEET,
                    lambda: self._mishap(drone),
                )
            result = await self.sky.fly(drone, *stops)
            if isinstance(result, FlightFailed):
                if not await link.recover(drone):
                    return
                continue
            await self.sky.pause(chance.choice([0.0, 1.0, 4.0]))
            what = chance.random()
            try:
                if what < 0.2:
                    await link.land(drone)
                elif what < 0.7:
                    await self.sky.goes_home(drone)
            except FlightFailed:
                if not await link.recover(drone):
                    return
        await self.sky.goes_home(drone)

    def _mishap(self, drone: str) -> None:
        if not self.sky.navigation.telemetry[drone].landed:
            what = self.chance.choice([Failure.LINK, Failure.CRASH, Failure.BATTERY, None])
            if what is not None:
                self.sky.navigation.strike(drone, what)


def is_home(sky: Sky, drone: FleetDrone) -> bool:
    """Return whether a drone stands in its dock."""
    telemetry = sky.navigation.telemetry[drone.id]
    return telemetry.landed and docked(telemetry.location, drone.home)
