"""A team of fake drones under a gateway's kernel, and what a test does with it."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any, TypeVar

import pytest

from pluto_fleet.drones.localization import LocalizationFeed
from pluto_fleet.drones.real_fleet import RealDrone, RealFleet, RequiredAction
from pluto_fleet.drones.team import Team
from pluto_fleet.jobs.controls import FleetDrone, TakeOff
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.time.kernel import FLEET, Task
from tests.kit.drones import FakeDrone, the_loop

T = TypeVar("T")

SCOUT = Category(name="scout", speed=0.5, flight_time=420, charge_time=1200)
FIELD = Airspace(size=(10.0, 10.0), ceiling=3.0, no_fly=(((6, 6), (8, 6), (8, 8), (6, 8)),))


class Asked:
    """A kernel in real time, of which something is asked, and what was logged."""

    def __init__(self) -> None:
        self.kernel, self.log = RealTime(), list[str]()

    async def do(self, command: Coroutine[Any, Any, T]) -> T:
        """Have the kernel do something, and return what came of it."""
        return await self.kernel.offer(self.begin(command))

    def begin(self, command: Coroutine[Any, Any, T]) -> Task[T]:
        begun: list[Task[T]] = []

        def begin() -> None:
            task = self.kernel.spawn(command, FLEET, "a test")
            task.watch(lambda _: None)
            begun.append(task)

        self.kernel.post(begin)
        return begun[0]

    async def failure(self, command: Coroutine[Any, Any, object]) -> FlightFailed:
        """Have the kernel do what cannot be done, and return why."""
        with pytest.raises(FlightFailed) as failed:
            await self.do(command)
        return failed.value

    async def until(self, so: Callable[[], object], limit: float = 1000.0) -> float:
        """Wait until something is so, and return for how long that was."""
        loop = the_loop()
        began = loop.now
        while not so():
            assert loop.now - began < limit, f"not in {limit} s; the log: {self.log}"
            await asyncio.sleep(0.05)
        return loop.now - began


class Flown(Asked):
    """Some fake drones, and the team that they are."""

    def __init__(
        self,
        folder: Path,
        drones: Sequence[FakeDrone],
        wanted: Sequence[RequiredAction] = (),
        feeding: LocalizationFeed | None = None,
        category: Category = SCOUT,
        parameters: Mapping[str, float] | None = None,
    ) -> None:
        super().__init__()
        self.drones = {drone.id: drone for drone in drones}
        self.crafts = [
            FleetDrone(id=drone.id, category=category, home=drone.home) for drone in drones
        ]
        self.team = Team(
            self.kernel,
            self.crafts,
            self.drones,
            FIELD,
            folder=folder,
            say=self.log.append,
            real=RealFleet(
                drones=tuple(
                    RealDrone(id=id, navigation="", uri=None, options={}, parameters=parameters)
                    for id in self.drones
                    if parameters
                ),
                wanted=tuple(wanted),
            ),
            feeding=feeding,
            clock=the_loop().time,
        )

    async def up(self, drone: str = "cf1") -> FakeDrone:
        await self.do(self.team.drone_report(drone))
        await self.do(self.team.do(drone, TakeOff(1.0)))
        return self.drones[drone]


@asynccontextmanager
async def flying(
    folder: Path,
    *drones: FakeDrone,
    wanted: Sequence[RequiredAction] = (),
    feeding: LocalizationFeed | None = None,
    category: Category = SCOUT,
    parameters: Mapping[str, float] | None = None,
) -> AsyncIterator[Flown]:
    """Begin a team, and close it at the end; no thread is left of it."""
    before = set(threading.enumerate())
    flown = Flown(folder, drones or (FakeDrone(),), wanted, feeding, category, parameters)
    flown.team.begin()
    try:
        yield flown
    finally:
        await flown.team.close()
        for drone in flown.drones.values():
            drone.clings.clear()
    assert set(threading.enumerate()) <= before
    others = asyncio.all_tasks() - {asyncio.current_task()}
    clung = any(drone.clung for drone in flown.drones.values())
    assert clung or not others
    for task in others:
        task.cancel()
    await asyncio.gather(*others, return_exceptions=True)
    if flown.kernel.crashed is not None:
        raise flown.kernel.crashed
