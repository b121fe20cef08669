"""Drones come down together soon after the slowest would alone, and never too near to each other."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.fleet.reach import flight_seconds
from tests.library.gateway.traffic.real_skies import PRECISE, RealSky, late, quick
from tests.library.gateway.traffic.skies import ENDURING, Sky, is_home

APART = 0.5
ROWS = [(0.5 + column, 0.5 + 2.5 * row, 0.0) for row in range(2) for column in range(5)]
"""Ten docks, a metre apart in each row."""
NEXT = [(0.5 + (column + 1) % 5, 1.7 + 2.5 * row, 0.5) for row in range(2) for column in range(5)]
"""Before the dock of each one's neighbour: all ways home cross."""


def comes_down(homes: list[Point], places: list[Point], airspace: Airspace, how: Down) -> Sky:
    """Bring down drones that hover at these places."""
    sky = Sky([home[:2] for home in homes], airspace=airspace)
    sky.puts(*places)
    sky.look()
    assert sky.until(sky.gateway.bring_down(how), 300)
    return sky


@pytest.mark.parametrize("speed", [0.3, 0.5, 1.0, 2.0, 3.0])
def test_ten_whose_ways_cross_are_home_soon_after_the_slowest(speed: float) -> None:
    """A drone waits for no more than two others that go first, each as long as a metre takes."""
    airspace = Airspace(size=(6.0, 6.0), ceiling=2.5, cruise_height=0.5)
    seconds, sky = late(ROWS, NEXT, airspace, speed, Down.HOME)
    assert seconds <= 2 + 2 * quick(speed).motion.leg(1.0, speed)
    assert all(sky.navigation.flown(drone.id) > 0 for drone in sky.drones)
    assert sky.nearest >= APART
    assert all(is_home(sky, drone) for drone in sky.drones)


def test_who_has_the_longest_way_home_chooses_first() -> None:
    """Of two that meet where none goes over another, the one that is nearly home makes room."""
    homes, places = [(1.5, 0.5, 0.0), (6.5, 1.0, 0.0)], [(4.0, 1.0, 1.2), (0.5, 0.5, 1.2)]
    airspace = Airspace(size=(10.0, 1.0), ceiling=1.3)
    alone = comes_down(homes[1:], places[1:], airspace, Down.HOME).kernel.now
    sky = comes_down(homes, places, airspace, Down.HOME)
    assert sky.kernel.now <= alone + 1
    assert sky.nearest >= APART - 1e-6
    assert all(is_home(sky, drone) for drone in sky.drones)


def test_no_drone_waits_until_its_neighbour_says_that_it_stands() -> None:
    """A real drone says so seconds after it has landed: who lands beside it would be later still."""
    airspace = Airspace(size=(6.0, 6.0), cruise_height=0.5)
    homes, places = [(1.0, 1.0, 0.0), (1.6, 1.0, 0.0)], [(1.0, 4.0, 0.5), (4.6, 1.0, 0.5)]
    seconds, sky = late(homes, places, airspace, 1.0, Down.HOME)
    alone = RealSky(homes[1:], {0: places[1]}, airspace, 1.0).stop(Down.HOME)
    assert seconds < alone
    assert sky.nearest >= APART


def test_where_only_one_may_be_in_the_air_who_stands_goes_when_it_is_down() -> None:
    """No drone in the air waits for one that must not take off."""
    sky = Sky([(1.0, 1.0), (4.0, 1.0)], airspace=Airspace(size=(5.0, 5.0)), max_airborne=1)
    sky.put("cf1", (4.0, 3.0, 0.0))
    sky.put("cf2", (1.0, 1.2, 1.2))
    sky.navigation.bodies["cf1"].touch_down(0.0)
    assert sky.until(sky.another().bring_down(Down.HOME), 300)
    assert sky.airborne <= 1
    assert all(is_home(sky, drone) for drone in sky.drones)


@pytest.mark.parametrize(("drain", "goes"), [(0.5, True), (1.0, True), (2.0, False)])
def test_a_drone_whose_battery_drains_too_fast_for_its_way_home_lands_where_it_is(
    drain: float, goes: bool
) -> None:
    """What it has left lasts for one and a half times of that way, with an ordinary drain."""
    here, home, airspace = (15.0, 1.0, 1.2), (1.0, 1.0, 0.0), Airspace()
    motion = replace(PRECISE, drain=drain)
    category = replace(ENDURING, motion=motion)
    enough = 1.5 * flight_seconds(category, airspace, here, [home], 0.0)
    sky = Sky([home[:2]], airspace=airspace, category=replace(category, flight_time=enough))
    sky.put("cf1", here)
    assert sky.until(sky.another().bring_down(Down.HOME), 300)
    body = sky.navigation.bodies["cf1"]
    assert (body.down, body.location) == (None, home if goes else (*here[:2], 0.0))
