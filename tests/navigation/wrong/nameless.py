"""Refuses with an exception that says nothing of what it is to the app."""

from __future__ import annotations

from pluto_fleet.drones import Rejected
from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_go_to_is_refused_on_the_ground"
SAYS = "a refusal's failure is REFUSED"


class Wrong(Simulated):
    """The runtime takes it for a mistake."""

    async def go_to(self, target: Point, speed: float) -> None:
        try:
            await super().go_to(target, speed)
        except Rejected as error:
            raise RuntimeError("state 3") from error
