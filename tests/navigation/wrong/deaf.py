"""Takes silence for consent."""

from __future__ import annotations

from contextlib import suppress

from pluto_fleet.drones import LinkLost
from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_a_drone_that_falls_silent_is_a_lost_link"
SAYS = "returned as if nothing had happened"


class Wrong(Simulated):
    """It is said to be there, and that is not known."""

    async def go_to(self, target: Point, speed: float) -> None:
        with suppress(LinkLost):
            await super().go_to(target, speed)
