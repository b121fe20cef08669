"""Courses: how fast they are, where a drone stops, and when it has arrived."""

from __future__ import annotations

from math import dist, inf, nan
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.crazyflie import flying as trajectory
from pluto_fleet.crazyflie.flying import SpeedLimits
from pluto_fleet.crazyflie.state import State
from pluto_fleet.crtp.body import AxisState as Start
from pluto_fleet.crtp.body import Body, profile
from pluto_fleet.shared.domain.motion import PEAK
from tests.library.crazyflie.hangar import state


@given(metres=st.floats(0.0, 30.0), speed=st.floats(0.05, 5.0))
def test_no_course_is_faster_than_its_limit_nor_throws_the_drone_over(
    metres: float, speed: float
) -> None:
    seconds = trajectory.shortest_duration(metres, speed)
    course = profile(Start(0.0), metres, seconds)
    steps = [course.at(seconds * step / 100) for step in range(101)]
    assert max(step.velocity for step in steps) <= speed + 1e-6
    assert max(abs(step.acceleration) for step in steps) <= 10.0


@given(speed=st.floats(0.0, 3.0))
def test_a_drone_that_is_to_stop_stops_within_its_way_of_a_third_of_a_second(speed: float) -> None:
    target, seconds = trajectory.braking(state(0.0), state(0.1, x=speed * 0.1))
    begun = speed * 0.1
    course = profile(Start(begun, speed), target[0], seconds)
    farthest = max(course.at(seconds * step / 100).position for step in range(101))
    assert farthest - begun <= 0.28 * speed * seconds + 1e-6
    assert target[1:] == (0.0, 1.0)


def test_the_clock_of_the_log_begins_anew_in_flight() -> None:
    before, now = state(0.0, sent=16777.2), state(0.1, x=0.1, sent=0.084)
    assert now.since(before) == pytest.approx(0.1)
    assert trajectory.braking(before, now)[0][0] == pytest.approx(0.3, abs=0.001)


def near(_: State) -> float:
    return 0.0


def test_a_drone_hovers_once_it_has_not_moved_for_a_moment() -> None:
    """The end of its course says nothing: its commander waits there for the drone."""
    comes = [state(tick / 10, x=0.04 * tick) for tick in range(6)]
    sways = [state(tick / 10, x=0.02 * (tick % 2)) for tick in range(6)]
    assert not trajectory.hovers(comes, near) and trajectory.hovers(sways, near)
    assert not trajectory.hovers(sways[:3], near)  # that is not known yet
    stands = [state(0.5 + tick / 10, x=0.2) for tick in (1, 2, 3)]
    assert not trajectory.hovers([*comes, *stands[:2]], near)
    assert trajectory.hovers([*comes, *stands], near)
    assert not trajectory.hovers(sways, lambda _: nan)


# A drone that comes down fast from a detour shoots over by more than a decimetre, and creeps back.
@pytest.mark.parametrize("metres", [0.8, 1.3, 1.9, -1.1])
@pytest.mark.parametrize("seed", range(10))
def test_what_is_done_at_the_end_of_a_fast_climb_or_descent_is_done_within_about_a_decimetre(
    metres: float, seed: int
) -> None:
    body = Body((0.0, 0.0, 1.0 + max(0.0, metres)), Random(seed))
    target = (0.0, 0.0, body.position[2] - metres)
    seconds = SpeedLimits((1.0, 1.0, 1.0)).seconds(body.position, target, 1.0)
    body.fly(target, 0.0, seconds, 0.0, landing=False)
    told: list[State] = []
    arrived, ticks = inf, 0
    while (now := ticks / 100) < arrived + 1.0:
        body.step(now, 0.01)
        if ticks % 10 == seed:  # it tells where it is ten times a second
            told.append(state(now, at=body.position))
            there = trajectory.hovers(told[-10:], lambda one: one.distance(target))
            arrived = min(arrived, now) if there and now >= seconds else arrived
        if now >= arrived:
            assert dist(body.position, target) <= 0.115
        ticks += 1
    assert arrived < seconds + trajectory.SLACK


def test_a_course_is_followed_on_each_axis() -> None:
    pace = SpeedLimits((1.0, 0.8, 0.5))
    assert pace.seconds((0, 0, 1), (8, 0, 1), 3.0) == pytest.approx(PEAK * 10)
    assert pace.seconds((0, 0, 0), (0, 0, 2), 3.0) == pytest.approx(PEAK * 4)
    assert pace.seconds((0, 0, 1), (8, 0, 1), 0.5) == pytest.approx(PEAK * 16)
    assert list(SpeedLimits((inf, inf, inf)).too_slow_for(5.0)) == []
