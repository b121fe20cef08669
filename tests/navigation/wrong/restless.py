"""Goes on when a command is cancelled, and does not stop when it is told to hold."""

from __future__ import annotations

import asyncio

from plutoc_runtime.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_hold_stops_the_drone_here"
SAYS = "hold returned, and it moved"


class Wrong(Simulated):
    """Whoever gives the next command gives it to a drone that moves."""

    async def go_to(self, target: Point, speed: float) -> None:
        self.check(target, speed)
        self._going = asyncio.create_task(super().go_to(target, speed))
        await asyncio.shield(self._going)
