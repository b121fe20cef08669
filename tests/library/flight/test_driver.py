"""Driving a brain: it is called when it is due, and not otherwise."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.flight.driver import Driver
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.time.virtual import VirtualTime
from tests.kit import apps


def test_a_brain_is_called_a_few_times_a_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each call is due for a reason; none leaves another behind."""
    calls = 0
    advance = Brain.advance

    def counted(self: Brain, now: float) -> None:
        nonlocal calls
        calls += 1
        advance(self, now)

    monkeypatch.setattr(Brain, "advance", counted)
    weak = Category(name="scout", flight_time=200.0, charge_time=400.0)
    missions = [
        apps.mission(
            f"m{n}", *(apps.trip(f"{k}", (7.0 * n + k) % 18 + 1.0, n % 15 + 2.0) for k in (0, 1))
        )
        for n in range(20)
    ]
    on = apps.fleet(*((2.0 + 3 * n, 10.0, 0.0) for n in range(5)), apart=0.5)
    assert apps.flown(*missions, categories=(weak,), on=on).completed
    assert calls < 4 * 40


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
