"""Flies on when it has said that it holds."""

from __future__ import annotations

import asyncio

from tests.navigation.simulated import SPEED, Simulated

FOUND_BY = "test_hold_stops_the_drone_here"
SAYS = "hold returned, and it moved"

_FAR = (1000.0, 2.0, 1.0)
"""So far that it still flies when the check looks, however busy the machine is."""


class Wrong(Simulated):
    """The next command reaches a drone that moves."""

    _going: asyncio.Task[None] | None = None

    async def hold(self) -> None:
        if self.telemetry.flying:
            self._going = asyncio.create_task(self.go_to(_FAR, SPEED))

    async def land(self, speed: float) -> None:
        if self._going is not None:
            self._going.cancel()
            await asyncio.wait([self._going])
        await super().land(speed)
