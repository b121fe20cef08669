"""Flies a Wren: a whole navigation, for a drone whose library counts in centimetres and degrees."""

from __future__ import annotations

from collections.abc import AsyncIterator, Sequence
from contextlib import closing
from math import dist, radians

from wrenlib import Radio, State

from pluto_fleet.drones import DroneEvent, DroneSetup, DroneTelemetry, Point, Reports


class Wren:
    def __init__(self, setup: DroneSetup) -> None:
        self.radio, self.reports = Radio(setup.uri or ""), Reports(setup)

    @property
    def telemetry(self) -> DroneTelemetry:
        return self.reports.telemetry

    def events(self) -> AsyncIterator[DroneEvent]:
        return self.reports.events()

    def hear(self, told: State) -> None:
        self.reports.tell(
            position=(told.x / 100, told.y / 100, told.z / 100),
            yaw=radians(told.heading),
            battery_level=told.percent / 100,
            flying=told.mode in ("moving", "hovering"),
            crashed="it lies on the ground" if told.mode == "crashed" else "",
        )

    async def connect(self) -> None:
        self.radio.open(self.reports.from_thread(self.hear))
        await self.reports.until(lambda told: True, seconds=5)

    async def preflight(self) -> Sequence[str]:
        return [self.reports.crashed] if self.reports.crashed else []

    async def takeoff(self, height: float, speed: float) -> None:
        self.radio.send("up", height * 100, speed * 100)
        await self.reports.until(lambda told: abs(told.position[2] - height) < 0.05, seconds=60)

    async def go_to(self, target: Point, speed: float) -> None:
        self.reports.refuse(target, speed)
        self.radio.send("go", *(value * 100 for value in target), speed * 100)
        await self.reports.until(lambda told: dist(told.position, target) < 0.05, seconds=300)

    async def hold(self) -> None:
        self.radio.send("stop")
        await self.reports.until(lambda told: self.radio.mode != "moving", seconds=5)

    async def land(self, speed: float) -> None:
        self.radio.send("down", speed * 100)
        await self.reports.until(lambda told: not told.flying, seconds=60)

    async def emergency_stop(self) -> None:
        self.radio.send("off")

    async def close(self) -> None:
        with closing(self.radio), closing(self.reports):
            if self.telemetry.flying:
                await self.land(0.3)
