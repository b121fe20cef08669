"""Simulated flights on which nothing goes wrong: places, batteries, items, and cancelling."""

from __future__ import annotations

import pytest

from pluto_fleet.jobs.controls import Act, GoTo, Hold
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.model import Item
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.told import VirtualTime
from tests.library.simulation.flights import (
    at_home,
    failure,
    fly,
    hovering,
    order,
)

PILLS = Item(name="pills", mass=0.004)


def advance(kernel: VirtualTime, seconds: float) -> None:
    fly(kernel, kernel.sleep(seconds))


def test_a_cancelled_drone_hovers_where_it_is() -> None:
    """Half-way is where it stays, draining, until it is told otherwise."""
    kernel, navigation = at_home()
    telemetry = navigation.telemetry["cf1"]
    fly(kernel, navigation.takes_off("cf1", 1.2, order()))
    leg = kernel.spawn(navigation.do("cf1", GoTo((4, 5, 1.2))), FLEET, "leg")
    advance(kernel, 5)
    leg.cancel()
    advance(kernel, 30)
    assert telemetry.location == pytest.approx((2.5, 3, 1.2))
    assert telemetry.battery_level == pytest.approx(1 - 39 / 420)
    fly(kernel, navigation.do("cf1", GoTo((2.5, 4, 1.2))))
    assert kernel.now == pytest.approx(41)
    assert navigation.flown("cf1") == pytest.approx(1.2 + 2.5 + 1)


@pytest.mark.parametrize(
    ("before", "action", "item", "reason"),
    [
        (None, "release_item", PILLS, "cf1 carries nothing, not pills"),
        (PILLS, "pick_item", PILLS, "cf1 already carries pills"),
    ],
)
def test_what_a_gripper_cannot_do_fails(
    before: Item | None, action: str, item: Item | None, reason: str
) -> None:
    """Picking twice, and releasing what is not there, fail the flight and say so."""
    kernel, navigation = hovering()
    if before:
        fly(kernel, navigation.do("cf1", Act("pick_item", {}, before)))
    error = failure(kernel, navigation.do("cf1", Act(action, {}, item)))
    assert error.failure is Failure.ACTION
    assert str(error) == f"{action} failed: {reason} at (1, 1)"
    assert navigation.carrying("cf1") is before


def test_no_drone_is_commanded_twice_at_once() -> None:
    """Two commands at a time are a mistake of the caller, not a failed flight."""
    kernel, navigation = hovering()
    kernel.spawn(navigation.do("cf1", Hold()), FLEET, "hover")
    with pytest.raises(RuntimeError, match=r"cf1 was told to fly to \(2, 2\) while told to hover"):
        fly(kernel, navigation.do("cf1", GoTo((2, 2, 1))))
