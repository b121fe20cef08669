"""Flies to the nearest place that it can reach, instead of refusing."""

from __future__ import annotations

from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_a_bad_target_is_refused_before_anything_moves"
SAYS = "go_to below the ground was done, and not refused"


class Wrong(Simulated):
    """Below the ground is not on the ground."""

    async def go_to(self, target: Point, speed: float) -> None:
        x, y, z = target
        await super().go_to((x, y, max(z, 0.2)), speed)
