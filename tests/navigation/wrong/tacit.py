"""Says of a crash only to the caller of a command that it failed."""

from __future__ import annotations

from collections.abc import AsyncIterator

from pluto_fleet.drones import DroneEvent
from tests.navigation.simulated import Simulated

FOUND_BY = "test_a_drone_that_crashes_is_a_crash"
SAYS = "no event told that it crashed"


class Wrong(Simulated):
    """One that hovers tells nothing."""

    async def events(self) -> AsyncIterator[DroneEvent]:
        async for event in super().events():
            if event.kind != "crashed":
                yield event
