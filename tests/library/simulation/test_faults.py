"""Simulated flights on which something goes wrong, at its very moment, and what comes after."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.jobs.controls import Act, GoTo, Land
from pluto_fleet.shared.alone.world import Faults, draw
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.fleet.reach import docked
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.told import VirtualTime
from tests.library.simulation.flights import (
    CLIMB,
    HOME,
    Team,
    at_home,
    failure,
    fly,
    hovering,
    order,
    team,
)

FAR = (4.0, 5.0, 1.2)


async def flight(navigation: Team, target: Point = FAR) -> object:
    """A trip with nothing left out, as the engine flies it."""
    await navigation.takes_off("cf1", 1.2, order())
    await navigation.do("cf1", GoTo(target))
    return await navigation.do("cf1", Act("take_photo", {}, None))


def place_at(seconds: float) -> Point:
    """Where the flight to FAR is after so many seconds."""
    if seconds <= CLIMB:
        return 1, 1, seconds * 0.3
    part = min(1.0, (seconds - CLIMB) / 10)
    return 1 + 3 * part, 1 + 4 * part, 1.2


@given(st.integers(0, 500))
def test_a_crash_comes_at_its_moment(seed: int) -> None:
    """The drone lies below where it was then, keeps its charge, and is lost."""
    kernel, navigation = at_home(Faults(crash=1), seed=seed)
    moment = draw(Faults(crash=1), seed, *order())[Failure.CRASH]
    error = failure(kernel, flight(navigation))
    x, y, _ = place_at(moment)
    telemetry = navigation.telemetry["cf1"]
    assert error.failure is Failure.CRASH
    assert kernel.now == pytest.approx(moment)
    assert telemetry.location == pytest.approx((x, y, 0))
    assert telemetry.landed
    assert telemetry.battery_level == pytest.approx(1 - moment / 420)
    assert not fly(kernel, navigation.recover("cf1"))
    assert kernel.now == pytest.approx(moment)
    assert failure(kernel, navigation.takes_off("cf1", 1.2, None)).failure is Failure.CRASH


def test_a_mishap_comes_even_without_commands() -> None:
    """A drone that was left hovering falls when its battery is empty, and says so later."""
    kernel, navigation = hovering(battery_level=0.02)
    fly(kernel, kernel.sleep(1000))
    telemetry = navigation.telemetry["cf1"]
    assert telemetry.location == HOME
    assert telemetry.landed
    assert failure(kernel, navigation.do("cf1", Land())).failure is Failure.BATTERY


@given(st.integers(0, 300), st.floats(0, 80), st.floats(0.005, 1))
def test_under_all_mishaps_the_drone_comes_home_or_is_lost(
    seed: int, abort: float, level: float
) -> None:
    """Faults, empty batteries and an abort at any moment: it ends docked, or crashed for good."""
    kernel = VirtualTime()
    faults = Faults(crash=0.2, link=0.4, action=0.3, battery=0.2)
    navigation = team(kernel, faults, seed=seed, battery_level=level)
    telemetry = navigation.telemetry["cf1"]
    trip = kernel.spawn(flight(navigation), FLEET, "trip")
    trip.watch(lambda _: None)
    fly(kernel, kernel.sleep(abort))
    trip.cancel()
    home = fly(kernel, navigation.recover("cf1"))
    assert telemetry.landed
    assert 0 <= telemetry.battery_level <= 1
    if home:
        assert docked(telemetry.location, HOME)
        before = telemetry.battery_level
        fly(kernel, kernel.sleep(12))
        assert telemetry.battery_level == pytest.approx(min(1, before + 0.01))
        fly(kernel, navigation.takes_off("cf1", 1.2, None))
    else:
        assert failure(kernel, navigation.do("cf1", Land())).failure is Failure.CRASH
    assert navigation.carrying("cf1") is None
