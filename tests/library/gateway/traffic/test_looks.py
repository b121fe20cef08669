"""When a drone that waits is looked at, and what a look may rely on."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pluto_fleet.gateway.traffic.legs import between, leaves
from pluto_fleet.gateway.traffic.reservations import Reservation, meets, part_way
from pluto_fleet.gateway.traffic.traffic import AGAIN
from pluto_fleet.gateway.traffic.wait_queue import HOVERS, Obstacle
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Point
from tests.library.gateway.traffic.skies import Sky

LOW = 1.3
"""A ceiling so low that no drone can go over another."""
LIMIT = 0.5


def test_who_waits_for_one_that_hovers_goes_soon_after_that_is_somewhere_else() -> None:
    """It may drift away, which nobody tells: it is looked at every few seconds."""
    sky = Sky([(1, 5), (5, 1)], airspace=Airspace(ceiling=LOW))
    assert sky.until(sky.gives("cf1", (5, 5, 1.2)), 60)
    second = sky.gives("cf2", (5, 9, 1.2))
    sky.advance(10 * HOVERS)
    assert sky.navigation.telemetry["cf2"].landed
    sky.put("cf1", (1, 1, 1.2))
    sky.advance(HOVERS + 2 * AGAIN)
    assert not sky.navigation.telemetry["cf2"].landed
    assert sky.until(second, 60)


def test_a_route_that_was_found_clear_does_not_count_once_its_drone_is_somewhere_else() -> None:
    """A real drone may be blown off its route: before a way is given, all are looked at where they are."""
    sky = Sky([(1, 5), (5, 1), (9, 1)], airspace=Airspace(ceiling=LOW))
    for drone, place in {"cf3": (9.0, 2.0, 1.2), "cf1": (5.0, 5.0, 1.2)}.items():
        assert sky.until(sky.gives(drone, place), 60)
    sky.gives("cf2", (5, 7, 1.2))
    sky.gives("cf3", (9, 9, 1.2), (3, 9, 1.2))
    sky.advance(4)
    sky.put("cf3", (5, 6, 1.2))
    sky.sends(sky.goes_home("cf1"))
    sky.advance(8)
    where = {drone: seen.location for drone, seen in sky.navigation.telemetry.items()}
    assert where == {"cf1": (1, 5, 1.2), "cf2": (5, 1, 0), "cf3": (5, 6, 1.2)}


def test_who_is_to_let_an_older_one_pass_goes_once_that_waits_no_more() -> None:
    """Nothing else has to change."""
    sky = Sky([(5, 0.5), (1, 5), (9, 7)], airspace=Airspace(ceiling=LOW))
    assert sky.until(sky.gives("cf2", (5, 5, 1.2)), 60)
    sky.gives("cf1", (5, 9, 1.2))
    sky.advance(1)
    younger = sky.gives("cf3", (5, 7, 1.2))
    sky.advance(20)
    assert sky.navigation.telemetry["cf3"].landed
    sky.commander.break_off("cf1")
    sky.advance(2 * AGAIN)
    assert not sky.navigation.telemetry["cf3"].landed
    assert sky.until(younger, 60)


@pytest.mark.parametrize(("seconds", "waits"), [(0.0, False), (0.05, False), (0.2, True)])
def test_requests_count_as_simultaneous_that_come_one_right_after_the_other(
    seconds: float, waits: bool
) -> None:
    """Those of one instant do in a simulation, and so must they where they come over a line."""
    sky = Sky([(5, 0.5), (1, 5), (9, 7)], airspace=Airspace(ceiling=LOW))
    assert sky.until(sky.gives("cf2", (5, 5, 1.2)), 60)
    sky.gives("cf1", (5, 9, 1.2))
    sky.advance(seconds)
    sky.gives("cf3", (5, 7, 1.2))
    sky.advance(5)
    assert sky.navigation.telemetry["cf3"].landed == waits


metres = st.one_of(st.integers(0, 3).map(float), st.floats(0, 3))
places = st.tuples(metres, metres, metres)


@given(places, places, places, places)
def test_a_drone_leaves_another_way_when_it_is_said_to(
    a: Point, b: Point, c: Point, d: Point
) -> None:
    assume(between(a, b, c, d) < LIMIT)
    part = leaves(a, b, c, d, LIMIT)
    before, after = (part_way(a, b, min(1.0, max(0.0, part + step))) for step in (-1e-6, 1e-6))
    assert between(before, b, c, d) < LIMIT + 1e-9
    if part < 1.0:
        assert between(after, b, c, d) > LIMIT - 1e-9


QUICK = Category(name="quick", speed=2.0)


@dataclass
class Seen:
    """The telemetry of a drone that flies exactly as fast as it may."""

    location: Point
    battery_level: float = 1.0
    landed: bool = False
    silence: float = 0.0


def test_who_crosses_a_way_at_its_end_needs_no_look_before() -> None:
    telemetry = Seen((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.moves_along(((0.0, 0.0, 1.0), (10.0, 0.0, 1.0)), ())
    obstacle = Obstacle(claim, QUICK, False)
    obstacle.seen(((9.0, -1.0, 1.0), (9.0, 1.0, 1.0)), LIMIT, 0.0)
    assert obstacle.is_sure(4.0)
    assert not obstacle.is_sure(9.5 / QUICK.speed)


@pytest.mark.parametrize("what", ["goes", "rests", "sinks"])
def test_who_is_told_something_else_is_looked_at_again(what: str) -> None:
    telemetry = Seen((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.rests((), 0.0)
    obstacle = Obstacle(claim, QUICK, False)
    obstacle.seen(((0.0, 0.0, 1.0), (1.0, 0.0, 1.0)), LIMIT, 3.0)
    assert obstacle.is_sure(3.1)
    if what == "goes":
        claim.moves_along(((0.0, 0.0, 1.0), (0.0, 5.0, 1.0)), ())
    elif what == "rests":
        claim.rests((), 0.0)
    else:
        claim.sinks()
    assert not obstacle.is_sure(3.1)


def test_who_has_not_come_to_a_stop_is_looked_at_when_it_has() -> None:
    telemetry = Seen((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.rests(((0.6, 0.0, 1.0),), 2.0)
    obstacle = Obstacle(claim, QUICK, True)
    obstacle.seen(((0.0, 0.0, 1.0), (1.0, 0.0, 1.0)), LIMIT, 0.0)
    assert obstacle.is_sure(1.9)
    assert not obstacle.is_sure(2.0)


def test_one_that_falls_silent_keeps_the_leg_that_it_was_told_to_fly_and_no_further_one() -> None:
    """Autopilots fly their last leg to its end without a ground station, and hover there until they land."""
    telemetry = Seen((3.0, 0.0, 2.0))
    claim = Reservation("one", telemetry)
    claim.moves_along(((0.0, 0.0, 2.0), (10.0, 0.0, 2.0), (10.0, 10.0, 2.0)), ())
    claim.sinks()
    for _ in range(2):
        shape = claim.shape(0.0)
        assert shape[0] == telemetry.location
        assert meets(shape, ((7.0, -1.0, 2.0), (7.0, 1.0, 2.0)), LIMIT)
        assert meets(shape, ((10.0, 0.0, 0.5),), LIMIT)
        assert meets(shape, ((3.0, 0.0, 0.5),), LIMIT)
        assert not meets(shape, ((10.0, 5.0, 2.0),), LIMIT)
        claim.sinks()
