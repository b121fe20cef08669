"""Returns when the drone has been told, and not when it is there."""

from __future__ import annotations

import asyncio

from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_go_to_returns_on_arrival_and_not_before"
SAYS = "m before its target"


class Wrong(Simulated):
    """Acknowledged is not arrived."""

    async def go_to(self, target: Point, speed: float) -> None:
        going = asyncio.create_task(super().go_to(target, speed))
        await asyncio.wait([going], timeout=0.05)
        if going.done():
            await going
