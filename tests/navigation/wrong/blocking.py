"""Calls a library that waits, on the event loop."""

from __future__ import annotations

import time

from plutoc_runtime.domain.model import Point
from tests.navigation.simulated import Simulated

FOUND_BY = "test_the_event_loop_is_never_held_up"
SAYS = "blocking.py:"


def send() -> None:
    """What many libraries do: return when there is an answer."""
    time.sleep(0.15)


class Wrong(Simulated):
    """No other drone flies meanwhile."""

    async def go_to(self, target: Point, speed: float) -> None:
        self.check(target, speed)
        send()
        await super().go_to(target, speed)
