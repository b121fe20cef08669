"""A navigation over one simulated drone, in real time: what the kit's own tests fly."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from functools import partial
from math import inf, isfinite
from pathlib import Path

from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.errors import BatteryLow, Crashed, LinkLost, OutsideArea, Rejected
from pluto_fleet.drones.protocol import (
    CRASHED,
    DroneEvent,
    DroneNavigation,
    DroneSetup,
    DroneTelemetry,
)
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.time.kernel import Task
from pluto_fleet.simulation.body import SimulatedDrone
from pluto_fleet.simulation.drones import SimulatedNavigation

PACE = 10.0
"""How fast time passes for the simulated drone: one of 0.5 m/s flies at 5."""
SPEED = 0.5 * PACE
YAW = 1.0
"""It never turns."""


class Simulated:
    """One simulated drone."""

    def __init__(self, setup: DroneSetup) -> None:
        self.id, self._there = setup.id, setup.uri is not None
        category = Category(name="scout", speed=0.5)
        drone = SimulatedDrone(id=setup.id, category=category, home=setup.home)
        self._kernel = RealTime(speed=PACE)
        self.team = SimulatedNavigation(
            self._kernel, [drone], World(0, Airspace()), Faults(), 0, Airspace()
        )
        self.body = self.team.bodies[setup.id]
        self.muted = False
        self._telemetry = self._look(-inf)
        self._ticking: asyncio.Task[None] | None = None
        self._events: asyncio.Queue[DroneEvent | None] = asyncio.Queue()

    @property
    def telemetry(self) -> DroneTelemetry:
        """The last it told."""
        return self._telemetry

    async def connect(self) -> None:
        """Listen to it."""
        if not self._there:
            raise LinkLost(f"{self.id} is not there")
        await self._listen_no_more()
        self._telemetry = self._look(time.monotonic())
        self._ticking = asyncio.create_task(self._tick())

    async def preflight(self) -> Sequence[str]:
        """Return nothing: it is always ready."""
        return []

    async def takeoff(self, height: float, speed: float) -> None:
        """Rise."""
        await self.obey(self.team.takeoff(self.id, height))

    async def go_to(self, target: Point, speed: float) -> None:
        """Fly straight to a point."""
        self.check(target, speed)
        await self.obey(self.team.go_to(self.id, target))

    async def hold(self) -> None:
        """Hover: it stops by itself when its command is cancelled."""

    async def land(self, speed: float) -> None:
        """Come down."""
        await self.obey(self.team.land(self.id))

    async def emergency_stop(self) -> None:
        """Fall."""
        await self.obey(self.team.cut(self.id))

    async def close(self) -> None:
        """Let go."""
        await self._listen_no_more()
        self._events.put_nowait(None)

    async def _listen_no_more(self) -> None:
        if self._ticking is not None:
            self._ticking.cancel()
            await asyncio.wait([self._ticking])

    async def events(self) -> AsyncIterator[DroneEvent]:
        """Yield what happens."""
        while (event := await self._events.get()) is not None:
            yield event

    def check(self, target: Point, speed: float) -> None:
        """Refuse what cannot be."""
        if not all(map(isfinite, target)) or target[2] < 0:
            raise OutsideArea(f"{self.id} cannot fly to {target}")
        if not 0 < speed < inf:
            raise Rejected(f"{self.id} cannot fly at {speed} m/s")

    async def obey(self, command: Coroutine[object, object, None]) -> None:
        """Do this in the simulation."""
        tasks: list[Task[None]] = []

        def begin() -> None:
            task = self._kernel.spawn(command, self.body.key, self.id)
            task.watch(lambda _: None)  # who waits for it hears of its errors
            tasks.append(task)

        self._kernel.post(begin)
        try:
            while self.muted or not tasks[0].is_set:
                self.hear()
                await asyncio.sleep(0.005)
            self._telemetry = self.told()
            tasks[0].result()
        except FlightFailed as error:
            raise _FAILURES[error.failure](str(error)) from error
        finally:
            self._kernel.post(tasks[0].cancel)

    def hear(self) -> None:
        """Raise if it has been silent for long."""
        if time.monotonic() - self._telemetry.time > 1.0:
            raise LinkLost(f"{self.id} is silent")

    def told(self) -> DroneTelemetry:
        """Return what it tells now, if anything."""
        return self._telemetry if self.muted else self._look(time.monotonic())

    def crash(self) -> None:
        """Let it crash."""
        self._kernel.post(partial(self.team.strike, self.id, Failure.CRASH))
        self._events.put_nowait(DroneEvent(kind=CRASHED, reason="it crashed"))

    def _look(self, now: float) -> DroneTelemetry:
        return DroneTelemetry(
            time=now,
            position=self.body.location,
            yaw=YAW,
            voltage=4.0,
            battery_level=self.body.battery_level,
            flying=not self.body.landed,
        )

    async def _tick(self) -> None:
        while True:
            await asyncio.sleep(0.02)
            self._telemetry = self.told()


_FAILURES: dict[Failure, Callable[[str], Exception]] = {
    Failure.CRASH: Crashed,
    Failure.LINK: LinkLost,
    Failure.BATTERY: BatteryLow,
    Failure.REFUSED: Rejected,
}


def setup(uri: str | None = "simulated") -> DroneSetup:
    """Return the drone that is simulated: it stands aside of the map's corner."""
    return DroneSetup(
        id="cf1", uri=uri, home=(1.0, 2.0, 0.0), speed=SPEED, options={}, folder=Path()
    )


class SimulatedContract(NavigationContract):
    """The kit, over a simulated drone."""

    navigation: type[Simulated] = Simulated
    height, away, speed, rest = 1.0, 2.0, SPEED, 0.1
    may_fall = together = True

    def make(self) -> DroneNavigation:
        return self.navigation(setup())

    def make_unreachable(self) -> DroneNavigation:
        return self.navigation(setup(uri=None))

    def silence(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Simulated)
        navigation.muted = True

    def crash(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Simulated)
        navigation.crash()

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        assert isinstance(navigation, Simulated)
        body = navigation.body
        return Truth(position=body.location, yaw=YAW, motors=not body.landed)
