"""A gateway and its team of Crazyflies in this very loop: simulated, but reached through cflib.

In a loop whose clock jumps, all of it is flown in virtual time.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Coroutine, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.team import Team
from pluto_fleet.drones.vehicle import TeamDrone
from pluto_fleet.gateway.gateway import Gateway, Link
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.actions import Plain
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.domain.model import Category, Item, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.time.kernel import FLEET, Task
from tests.library.crazyflie.hangar import navigation

T = TypeVar("T")

QUICK = Category(name="quick", speed=1.0, flight_time=420, charge_time=1200)
HALL = Airspace(size=(20.0, 20.0), cruise_height=0.8, ceiling=6.0)
APART = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetDrone:
    """A drone as the gateway knows it."""

    id: str
    home: Point
    index: int
    category: Category = QUICK


@dataclass(slots=True, kw_only=True)
class Measuring:
    """A job: fly there, and measure."""

    drone: str
    stops: tuple[Point, ...]
    action: str | None = "measure"
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    item: Item | None = None
    seconds: float = 1.0
    beside: bool = True
    number: int = 1

    @property
    def id(self) -> str:
        """Which flight it is."""
        return f"Hall/{self.drone}/0/{self.number}"

    def begins(self) -> None:
        """The action is about to be done."""


class Flown:
    """What a test does with them."""

    def __init__(self, kernel: RealTime, team: Team, gateway: Gateway, log: list[str]) -> None:
        self.kernel, self.team, self.gateway, self.log = kernel, team, gateway, log
        self.link: Link = gateway.link(1)

    def begin(self, command: Coroutine[Any, Any, T]) -> Task[T]:
        """Have the kernel do something."""
        begun: list[Task[T]] = []

        def begin() -> None:
            task = self.kernel.spawn(command, FLEET, "a test")
            task.watch(lambda _: None)
            begun.append(task)

        self.kernel.post(begin)
        return begun[0]

    async def do(self, command: Coroutine[Any, Any, T], limit: float = 60.0) -> T:
        """Have the kernel do something, and return what came of it."""
        async with asyncio.timeout(limit):
            return await self.kernel.offer(self.begin(command))

    async def flies(
        self, drone: str, *stops: Point, action: str | None = "measure", number: int = 1
    ) -> object:
        """Let a drone fly a job, and return what was reported of it."""
        heard: asyncio.Future[object] = asyncio.get_running_loop().create_future()
        job = Measuring(drone=drone, stops=stops, action=action, number=number)
        self.kernel.post(self.link.fly, job, heard.set_result)
        async with asyncio.timeout(150.0):
            return await heard

    async def fails(self, drone: str, *stops: Point) -> FlightFailed:
        """Let a drone fly a job that cannot end well, and return why."""
        result = await self.flies(drone, *stops)
        assert isinstance(result, FlightFailed), result
        return result


@asynccontextmanager
async def commanded(
    folder: Path, homes: Mapping[str, Point], uris: Mapping[str, str], options: Mapping[str, object]
) -> AsyncIterator[Flown]:
    """Fly these drones; in the end all are landed, and no task is left."""
    before, log, loop = set(asyncio.all_tasks()), list[str](), asyncio.get_running_loop()
    kernel, began = RealTime(), loop.time()

    def say(line: str) -> None:
        log.append(f"{loop.time() - began:6.2f} {line}")

    def craft(id: str, home: Point) -> TeamDrone:
        flies = navigation(Build(id=id, home=home), uris[id], folder, options, QUICK.speed)
        return TeamDrone(id=id, category=QUICK, home=home, navigation=flies)

    drones = [craft(id, home) for id, home in homes.items()]
    team = Team(kernel, drones, HALL, folder=folder, say=say, clock=loop.time)
    crafts = [FleetDrone(id=id, home=home, index=i) for i, (id, home) in enumerate(homes.items())]
    gateway = Gateway(kernel, team, crafts, HALL, apart=APART, slack=CRAZYFLIE.slack)
    team.begin()
    try:
        yield Flown(kernel, team, gateway, log)
    finally:
        await team.close()
        for task in list(kernel.tasks):
            kernel.post(task.cancel)
        await asyncio.sleep(0)
        await asyncio.sleep(0)
    if kernel.crashed is not None:
        raise kernel.crashed
    assert asyncio.all_tasks() - before == set(), log
