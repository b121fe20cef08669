"""What a drone tells of its battery, its place and its state, and the alarms that come of it."""

from __future__ import annotations

from math import nan

import pytest

from pluto_fleet.crazyflie.options import LOST_BEYOND, SURE_WITHIN
from pluto_fleet.crazyflie.state import AlarmDetector, PositionConfidence, State, state_of
from pluto_fleet.drones.protocol import BATTERY_LOW
from tests.library.crazyflie.hangar import state


def heard(states: list[State]) -> list[tuple[float, str]]:
    alarms = AlarmDetector()
    return [(one.time, event.kind) for one in states for event in alarms.hear(one)]


def test_a_battery_is_low_when_it_is_so_for_three_seconds_and_told_once() -> None:
    low = [state(tick / 10, volts=3.1) for tick in range(100)]
    assert heard(low) == [(3.0, BATTERY_LOW)]
    said = [state(tick / 10, volts=3.4, power=3) for tick in range(100)]
    assert heard(said) == [(3.0, BATTERY_LOW)]


def test_another_battery_can_be_low_again() -> None:
    flights = [*[3.1] * 50, *[4.1] * 10, *[3.1] * 50]
    told = heard([state(tick / 10, volts=volts) for tick, volts in enumerate(flights)])
    assert [kind for _, kind in told] == [BATTERY_LOW, BATTERY_LOW]


def test_a_state_is_in_radians_and_knows_its_bits() -> None:
    told = {"stateEstimate.yaw": 180.0, "supervisor.info": 0b1000011010, "pm.vbat": 4.0}
    read = state_of(told, 5.0, 1.0)
    assert read.yaw == pytest.approx(3.14159, abs=1e-4) and read.position == (0.0, 0.0, 0.0)
    assert read.armed and read.can_fly and read.flies and read.finished
    assert not (read.steered or read.crashed or read.locked)


def told(*variances: float, every: float = 0.25) -> PositionConfidence:
    certainty = PositionConfidence()
    for tick, variance in enumerate(variances):
        certainty.hear((1e-5, 1e-5, variance), tick * every)
    return certainty


def test_one_not_sure_within_the_last_second_is_not_sure() -> None:
    assert not told(*[1e-5] * 8, 0.5).sure(2.0, SURE_WITHIN)
    assert not told(*[1e-5] * 8, nan).sure(2.0, SURE_WITHIN)
    assert told(*[1e-5] * 8, 0.5).variance == 0.5
    assert not told(*[1e-5] * 5, 0.02).sure(1.25, SURE_WITHIN)
    assert told(*[0.02] * 5).sure(1.0, 0.15)


def test_a_place_is_lost_once_it_has_been_unknown_for_a_second() -> None:
    growing = [0.003, 0.02, 0.06, 0.1, 0.2, 0.4]
    assert not told(*growing).lost(LOST_BEYOND) and told(*growing).doubts(LOST_BEYOND)
    assert told(*growing, 0.6).lost(LOST_BEYOND)
    assert not told(*growing, 0.6, 0.04).lost(LOST_BEYOND)
    assert not told(*growing, 0.6).lost(1.0) and not PositionConfidence().lost(LOST_BEYOND)
