"""What is known of a drone between two messages."""

from __future__ import annotations

from math import inf
from typing import Any

import pytest

from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT, Motion, smoothly
from pluto_fleet.shared.fleet.telemetry import Charge, KnownState, Leg, place_on, resting

HOME = (1.0, 1.0, 0.0)
FIRST = Leg((0.0, 0.0, 1.0), (4.0, 0.0, 1.0), 10.0, 14.0)
SECOND = Leg((4.0, 0.0, 1.0), (4.0, 2.0, 3.0), 16.0, 20.0)


class Clock:
    """A clock that is set by hand."""

    now = 0.0


@pytest.mark.parametrize(
    ("now", "place"),
    [
        (9.0, (0.0, 0.0, 1.0)),
        (10.0, (0.0, 0.0, 1.0)),
        (11.0, (1.0, 0.0, 1.0)),
        (14.0, (4.0, 0.0, 1.0)),
        (15.0, (4.0, 0.0, 1.0)),
        (18.0, (4.0, 1.0, 2.0)),
        (20.0, (4.0, 2.0, 3.0)),
        (99.0, (4.0, 2.0, 3.0)),
    ],
)
def test_a_drone_is_on_the_leg_that_it_flies(now: float, place: tuple[float, ...]) -> None:
    """Between two legs it hovers."""
    assert place_on([FIRST, SECOND], now) == place


def test_who_stands_somewhere_from_a_moment_to_come_is_there_already() -> None:
    """A mishap may be due the last digit of a float after the event that brings it."""
    assert resting((1.0, 2.0, 0.0), 5.0).at(4.9999999) == (1.0, 2.0, 0.0)


@pytest.mark.parametrize(
    ("battery", "now", "level"),
    [
        (Charge(0.5, 10.0), 99.0, 0.5),
        (Charge(0.5, 10.0, -0.01), 5.0, 0.5),
        (Charge(0.5, 10.0, -0.01), 20.0, 0.4),
        (Charge(0.5, 10.0, -0.01), 61.0, 0.0),
        (Charge(0.5, 10.0, 0.01), 20.0, 0.6),
        (Charge(0.5, 10.0, 0.01), 99.0, 1.0),
    ],
)
def test_a_battery_drains_and_charges_within_its_bounds(
    battery: Charge, now: float, level: float
) -> None:
    assert battery.at(now) == pytest.approx(level)
    assert battery.changing(now, 0.25).at(now) == pytest.approx(level)


def test_when_a_battery_is_empty() -> None:
    assert Charge(0.5, 10.0, -0.01).empty_at == 60.0
    assert Charge(0.5, 10.0, 0.01).empty_at == Charge(0.5, 10.0).empty_at == inf


def told(motion: Motion = STRAIGHT, *messages: dict[str, Any]) -> tuple[KnownState, Clock]:
    """Return what is known after messages at 10 s."""
    clock = Clock()
    state = KnownState(clock, HOME, motion)
    clock.now = 10.0
    for message in messages:
        state.take(message)
    return state, clock


def test_what_a_message_does_not_say_stays_as_it_was() -> None:
    state, _ = told()
    assert (state.location, state.battery_level, state.landed) == (HOME, 0.0, True)
    state.take({"at": [2, 3, 1], "battery": 1, "landed": False})
    state.take({})
    state.take({"battery": 0.5})
    assert (state.location, state.battery_level, state.landed) == ((2, 3, 1), 0.5, False)
    state.take({"landed": True})
    assert (state.location, state.battery_level, state.landed) == ((2, 3, 1), 0.5, True)


@pytest.mark.parametrize(("motion", "part"), [(STRAIGHT, 0.25), (CRAZYFLIE, smoothly(0.25))])
def test_a_leg_is_flown_as_drones_of_the_fleet_move(motion: Motion, part: float) -> None:
    leg = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], 10.0, 14.0]
    for message in ({"legs": [leg]},):
        state, clock = told(motion, message, {"battery": [0.2, 10.0, 0.1]})
        clock.now = 11.0
        assert state.location == pytest.approx((4.0 * part, 0.0, 1.0))
        assert state.battery_level > 0.3 - 1e-9
        clock.now = 30.0
        assert (state.location, state.battery_level) == ((4.0, 0.0, 1.0), 1.0)


@pytest.mark.parametrize("name", ["take", "motion", "location", "anything"])
def test_who_sees_it_cannot_change_it(name: str) -> None:
    known = KnownState(Clock(), HOME, STRAIGHT)
    with pytest.raises(AttributeError):
        setattr(known, name, [])
