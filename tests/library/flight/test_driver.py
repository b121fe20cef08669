"""Driving a brain: it is called when it is due, and not otherwise."""

from __future__ import annotations

from typing import Any

from pluto_fleet.flight.driver import Driver
from pluto_fleet.shared.time.told import VirtualTime


def test_a_driver_forgets_a_call_that_is_not_due_any_more() -> None:
    """It schedules one call of its brain, however often that says when it is due."""

    class Due:
        over = None
        due: float | None = None

        def __init__(self) -> None:
            self.advanced: list[float] = []

        def events(self) -> list[Any]:
            return []

        orders = events

        def advance(self, now: float) -> None:
            self.advanced.append(now)
            self.due = None

    brain, kernel = Due(), VirtualTime()
    driver = Driver(kernel, brain, obey=print, motions=dict, hear=print)  # type: ignore[arg-type]
    for due in (5.0, 3.0, 7.0, 7.0):
        brain.due = due
        driver.pump()
    assert kernel.next_time() == 7.0
    kernel.now = 7.0
    kernel.drain()
    assert brain.advanced == [7.0]
    assert kernel.next_time() is None
