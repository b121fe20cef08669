"""Simulated Crazyflies in this very loop, and navigations that fly them through the real cflib."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crazyflie.state import State
from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.flight_log import CommandRecord, FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.protocol import DroneEvent, DroneSetup
from pluto_fleet.shared.domain.model import Point

FAST = 1.0
"""Metres per second: tests must not wait, and no course is followed faster."""
PATIENCE = 30.0
"""Seconds until what does not end is said to hang."""


@dataclass(slots=True)
class Hangar:
    """One simulated drone, who flies it, and what was heard of it."""

    navigation: Crazyflie
    server: Server
    record: FlightLog
    id: str
    events: list[DroneEvent] = field(default_factory=list)
    heard: asyncio.Event = field(default_factory=asyncio.Event)

    @property
    def drone(self) -> SimulatedCrazyflie:
        return self.server.drones[self.id]

    @property
    def position(self) -> Point:
        """Where it really is."""
        return self.drone.body.position

    @property
    def flies(self) -> bool:
        """Whether it really is in the air."""
        return self.drone.body.airborne

    @property
    def commands(self) -> list[CommandRecord]:
        """What it was commanded; who only asks what it is commands nothing."""
        return [command for command in self.record.commands if command.what != "asked"]

    def did(self, what: str) -> list[CommandRecord]:
        return [command for command in self.commands if command.what == what]

    async def connected(self) -> Crazyflie:
        """Connect to it; return who flies it."""
        await self.navigation.connect()
        return self.navigation

    async def up(self) -> Crazyflie:
        """Connect to it and let it hover half a metre high; return who flies it."""
        await self.navigation.connect()
        await self.navigation.takeoff(0.5, FAST)
        return self.navigation

    async def let(self, name: str, value: float | bool = True) -> None:
        await self.server.let(self.id, name, value)

    async def hears(self, kind: str) -> DroneEvent:
        """Return an event of this kind, as soon as there is one."""
        async with asyncio.timeout(PATIENCE):
            while True:
                for event in self.events:
                    if event.kind == kind:
                        return event
                self.heard.clear()
                await self.heard.wait()

    async def listen(self) -> None:
        async for event in self.navigation.events():
            self.events.append(event)
            self.heard.set()


def state(
    time: float,
    *,
    volts: float = 4.0,
    bits: int = 0,
    power: int = 0,
    x: float = 0.0,
    at: Point | None = None,
    sent: float | None = None,
) -> State:
    return State(
        time=time,
        sent=time if sent is None else sent,
        position=at or (x, 0.0, 1.0),
        yaw=0.0,
        volts=volts,
        power=power,
        bits=bits,
    )


def navigation(
    build: Build,
    uri: str | None,
    folder: Path,
    options: Mapping[str, object] | None = None,
    speed: float = FAST,
) -> Crazyflie:
    told, home = options or {}, build.home
    return Crazyflie(
        DroneSetup(id=build.id, uri=uri, home=home, speed=speed, options=told, folder=folder)
    )


@asynccontextmanager
async def hangar(
    folder: Path,
    options: Mapping[str, object] | None = None,
    build: Build | None = None,
    uri: str | None = None,
    speed: float = FAST,
) -> AsyncIterator[Hangar]:
    """Make a drone, not connected yet; in the end it is closed, and so is the simulation."""
    build = build or Build(id="cf1", home=(1.0, 2.0, 0.0))
    record = FlightLog()
    server = Server([build], record)
    await server.start()
    flies = navigation(build, uri or server.uris[build.id], folder, options, speed)
    one = Hangar(flies, server, record, build.id)
    listening = asyncio.create_task(one.listen())
    try:
        yield one
    finally:
        await one.navigation.close()
        async with asyncio.timeout(PATIENCE):
            await listening  # the events end
        await server.close()


def drone(**given: object) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("one", [given], indirect=True, ids=["given"])
