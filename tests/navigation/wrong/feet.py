"""Hands metres to a library that counts in feet, and tells what that says."""

from __future__ import annotations

from dataclasses import replace

from pluto_fleet.drones import DroneTelemetry
from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_it_counts_in_metres_and_radians_in_the_maps_frame"
SAYS = "which units, and which frame?"
FOOT = 0.3048


class Wrong(Simulated):
    """A metre is not a foot."""

    async def takeoff(self, height: float, speed: float) -> None:
        await super().takeoff(height * FOOT, speed)

    async def go_to(self, target: Point, speed: float) -> None:
        x, y, z = target
        await super().go_to((x * FOOT, y * FOOT, z * FOOT), speed)

    def told(self) -> DroneTelemetry:
        told = super().told()
        if self.muted:
            return told
        x, y, z = told.position
        return replace(told, position=(x / FOOT, y / FOOT, z / FOOT))
