"""The arithmetic of flights: seconds, and shares of a battery."""

from __future__ import annotations

from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.fleet.reach import docked, flight_seconds, needed

SCOUT = Category(name="scout", speed=0.5, flight_time=420)
PLAIN = Airspace(cruise_height=1.2)
WALL = Airspace(no_fly=(((8, 0), (9, 0), (9, 20), (8, 20)),))
CLIMB = 1.2 / 0.3

coordinate = st.floats(0, 20)
in_the_air = st.tuples(coordinate, coordinate, st.floats(0.1, 10))
on_the_ground = st.tuples(coordinate, coordinate, st.just(0.0))


def test_a_flight_from_the_ground_climbs_first() -> None:
    """A climb to cruise height, 5 m at half a metre a second, and the action."""
    seconds = flight_seconds(SCOUT, PLAIN, (1, 1, 0), [(4, 5, 1.2)], 3)
    assert seconds == pytest.approx(CLIMB + 10 + 3)


def test_a_flight_from_the_air_does_not_climb() -> None:
    """A drone that hovers goes straight there."""
    assert flight_seconds(SCOUT, PLAIN, (1, 1, 2), [(1, 1, 1)], 0) == pytest.approx(2)


def test_a_last_point_on_the_ground_is_landed_on() -> None:
    """The landing counts from the height of the last stop."""
    points = [(4, 5, 3.0), (1, 1, 0.0)]
    assert flight_seconds(SCOUT, PLAIN, (4, 5, 3), points, 0) == pytest.approx(10 + 10)


def test_no_points_is_no_flight() -> None:
    """A drone that goes nowhere needs the action's time alone."""
    assert flight_seconds(SCOUT, PLAIN, (1, 1, 0), [], 7) == 7


def test_where_no_way_leads_takes_for_ever() -> None:
    """Behind a wall without an end there is nothing to wait for."""
    assert flight_seconds(SCOUT, WALL, (1, 1, 0), [(15, 1, 1.2)], 0) == inf
    assert needed(SCOUT, WALL, (1, 1, 0), [((15, 1, 1.2), 1)], (1, 1, 0)) is None


def test_the_whole_trip_is_needed() -> None:
    """There, each action, back, and down; the reserve is added elsewhere."""
    stops = [((4.0, 5.0, 1.2), 2.0), ((4.0, 7.0, 1.2), 3.0)]
    seconds = CLIMB + 10 + 2 + 4 + 3 + 2 * (3**2 + 6**2) ** 0.5 + CLIMB
    assert needed(SCOUT, PLAIN, (1, 1, 0), stops, (1, 1, 0)) == pytest.approx(seconds / 420)


def test_a_dock_charges_who_lands_near_enough() -> None:
    """Twenty centimetres are near enough, at any height that home was written with."""
    assert docked((1.1, 1.1, 0), (1, 1, 0.5))
    assert not docked((1.2, 1.1, 0), (1, 1, 0))


@given(on_the_ground, st.lists(st.tuples(in_the_air, st.floats(0, 60)), max_size=4), on_the_ground)
def test_stopping_on_the_way_never_saves(
    start: tuple[float, float, float],
    stops: list[tuple[tuple[float, float, float], float]],
    home: tuple[float, float, float],
) -> None:
    """What is needed without the last stop is no more than with it, at one height."""
    level = [((x, y, PLAIN.cruise_height), seconds) for (x, y, _), seconds in stops]
    all_of_it = needed(SCOUT, PLAIN, start, level, home)
    less = needed(SCOUT, PLAIN, start, level[:-1], home)
    assert all_of_it is not None
    assert less is not None
    assert less <= all_of_it + 1e-9
