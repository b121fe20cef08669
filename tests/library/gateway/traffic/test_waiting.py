"""Who flies first, who goes round, who waits, and where."""

from __future__ import annotations

from dataclasses import replace
from math import dist, hypot

import pytest

from pluto_fleet.gateway.traffic.ways import Section
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STEADY
from pluto_fleet.shared.time.kernel import FLEET, Task
from tests.library.gateway.flights import PILLS
from tests.library.gateway.traffic.skies import ENDURING, Sky

APART = 0.5
LOW = Airspace(ceiling=1.3)
"""So low that no drone can go over another."""


def test_one_of_two_that_cross_goes_over_the_other() -> None:
    """Both leave at once, and neither waits."""
    sky = Sky([(1, 5), (5, 1)])
    jobs = sky.gives("cf1", (9, 5, 1.2)), sky.gives("cf2", (5, 9, 1.2))
    assert all(sky.until(job, 24) for job in jobs)
    assert sky.nearest >= APART - 1e-6
    assert sky.navigation.flown("cf1") == pytest.approx(9.2)
    assert 9.2 < sky.navigation.flown("cf2") <= 9.2 + 2 * APART


def test_below_a_low_ceiling_one_waits_on_the_ground_until_the_other_has_passed() -> None:
    """What lies behind a drone is free: it need not have arrived."""
    sky = Sky([(1, 5), (5, 1)], airspace=LOW)
    first, second = sky.gives("cf1", (9, 5, 1.2)), sky.gives("cf2", (5, 9, 1.2))
    sky.advance(10)
    assert sky.at("cf2") == (5, 1, 0)
    assert not first.is_set
    sky.advance(4)
    assert sky.at("cf2")[2] > 0
    assert not first.is_set
    assert sky.until(second, 30)
    assert sky.nearest >= APART - 1e-6


def test_one_that_hovers_a_little_too_high_is_passed_over() -> None:
    """No real drone hovers exactly where it was told to; there is room for one way over it."""
    sky = Sky([(5, 5), (1, 5)], airspace=Airspace(ceiling=2.0), slack=CRAZYFLIE.slack)
    sky.put("cf1", (5, 5, 1.24))
    sky.another()
    sky.commander = sky.link(sky.epoch)
    assert sky.until(sky.gives("cf2", (9, 5, 1.2)), 40)
    assert sky.nearest >= APART + CRAZYFLIE.slack - 1e-6


def test_a_few_centimetres_change_no_way() -> None:
    """Each hovers some centimetres off; the one way that is free leads along below the ceiling."""
    motion = replace(CRAZYFLIE.exact, spread=1e-9)
    high = Airspace(size=(10, 10), cruise_height=1.6, ceiling=3.0)
    sky = Sky(
        [(1, 5), (5, 1), (5, 9)],
        airspace=high,
        slack=CRAZYFLIE.slack,
        category=replace(ENDURING, motion=motion),
    )
    assert sky.until(sky.gives("cf3", (5, 5, 2.3)), 60)
    assert sky.until(sky.gives("cf2", (5, 5, 1.6)), 60)
    took = []
    heights = []
    for x in (2, 8) * 6:
        began = sky.kernel.now
        assert sky.until(sky.gives("cf1", (x, 5, 1.6)), 120)
        took.append(sky.kernel.now - began)
        heights.append(sky.at("cf1")[2])
    assert max(heights) - min(heights) > 0.04
    assert max(took[2:]) - min(took[2:]) < 0.3


def test_of_two_with_the_same_target_the_second_comes_when_the_first_has_gone() -> None:
    """Nothing else helps where an item is to be picked."""
    sky = Sky([(1, 1), (9, 1)])
    first, second = sky.gives("cf1", (5, 5, 1.2)), sky.gives("cf2", (5, 5, 1.2), item=PILLS)
    assert sky.until(first, 60)
    assert not sky.until(second, 60)
    home = sky.sends(sky.goes_home("cf1"))
    assert sky.until(second, 60)
    assert sky.until(home, 60)
    assert sky.nearest >= APART - 1e-6


def test_two_that_hover_in_each_others_way_do_not_wait_for_ever() -> None:
    """They change places below a low ceiling: one lands, and goes on when the other is home."""
    sky = Sky([(1, 5), (9, 5)], airspace=Airspace(size=(10, 5.2), ceiling=1.3))
    sky.puts((2, 5, 1.2), (8, 5, 1.2))

    async def there_and_home(drone: str, target: Point) -> Point:
        assert await sky.fly(drone, target, item=PILLS) is None
        reached = sky.at(drone)
        await sky.goes_home(drone)
        return reached

    first = sky.kernel.spawn(there_and_home("cf1", (8, 5, 1.2)), FLEET + 1, "cf1 is given a job")
    second = sky.kernel.spawn(there_and_home("cf2", (2, 5, 1.2)), FLEET + 2, "cf2 is given a job")
    assert sky.until(first, 200)
    assert sky.until(second, 200)
    assert sky.nearest >= APART - 1e-6
    assert (first.result(), second.result()) == ((8, 5, 1.2), (2, 5, 1.2))


def test_no_drone_lands_on_another() -> None:
    """Nor in another's dock; in its own it may, beside one that stands there."""
    sky = Sky([(1, 1), (1.3, 1), (5, 5)])
    jobs = [sky.gives("cf2", (5, 5, 1.2)), sky.gives("cf1", (8, 8, 1.2))]
    assert all(sky.until(job, 60) for job in jobs)
    land = sky.sends(sky.commander.land("cf2"))
    assert sky.until(land, 30)
    x, y, z = sky.at("cf2")
    assert z == 0
    assert APART <= hypot(x - 5, y - 5) <= APART + 0.3
    for drone in ("cf1", "cf2"):
        assert sky.until(sky.sends(sky.goes_home(drone)), 80)
    assert sky.at("cf1") == pytest.approx((1, 1, 0))
    assert sky.at("cf2") == pytest.approx((1.3, 1, 0))


def waits_for_one_that_hovers() -> tuple[Sky, Task[object]]:
    """Return three drones: cf1 stands and waits for cf2, which hovers half-way; cf3 stands beside."""
    sky = Sky([(5, 0.5), (1, 5), (9, 7)], airspace=LOW)
    sky.puts((5, 1, 1.2), (5, 5, 1.2), (9, 7, 1.2))
    for drone in ("cf1", "cf3"):
        assert sky.until(sky.sends(sky.commander.land(drone)), 20)
    return sky, sky.gives("cf1", (5, 9, 1.2))


def test_none_ends_where_one_that_came_before_wants_to_fly() -> None:
    """Else those who come and go could keep it for ever; where they stay for long, two are enough."""
    sky, elder = waits_for_one_that_hovers()
    sky.advance(1)
    younger = sky.gives("cf3", (5, 7, 1.2))
    sky.advance(5)
    assert sky.at("cf3") == (9, 7, 0)
    home = sky.sends(sky.goes_home("cf2"))
    assert sky.until(elder, 60)
    assert not younger.is_set
    assert sky.until(younger, 60)
    assert home.is_set
    assert sky.nearest >= APART - 1e-6


def test_who_only_crosses_flies_while_the_other_has_to_wait_anyway() -> None:
    """However long that has waited: for one that hovers in its way."""
    sky, elder = waits_for_one_that_hovers()
    sky.advance(25)
    younger = sky.gives("cf3", (1, 7, 1.2))
    assert sky.until(younger, 21)
    assert not elder.is_set
    home = sky.sends(sky.goes_home("cf2"))
    assert sky.until(elder, 60)
    assert home.is_set
    assert sky.nearest >= APART - 1e-6


def test_who_has_waited_long_flies_before_younger_ones_once_its_way_becomes_free() -> None:
    """Else those that cross could keep it for ever."""
    sky, elder = waits_for_one_that_hovers()
    sky.advance(25)
    sky.sends(sky.goes_home("cf2"))
    sky.advance(0.2)
    younger = sky.gives("cf3", (1, 7, 1.2))
    assert sky.until(elder, 60)
    assert not younger.is_set
    assert sky.until(younger, 60)
    assert sky.nearest >= APART - 1e-6


def test_where_the_ground_is_full_of_docks_a_drone_lands_in_its_own() -> None:
    """Real drones land further apart than docks may be."""
    sky = Sky([(0.1, 0.1), (0.6, 0.1)], airspace=Airspace(size=(0.7, 0.2)), slack=0.15)
    assert sky.until(sky.gives("cf1", (0.35, 0.1, 1.2)), 20)
    assert sky.until(sky.sends(sky.commander.land("cf1")), 20)
    assert sky.at("cf1") == (0.1, 0.1, 0)


def test_no_more_are_in_the_air_than_may_be() -> None:
    """Also if the brain asks for more: the others wait on the ground."""
    sky = Sky([(1, 1), (4, 1), (7, 1)], max_airborne=2)
    jobs = [sky.gives(f"cf{n}", (3 * n - 2, 5, 1.2)) for n in (1, 2, 3)]
    assert not sky.until(jobs[2], 60)
    assert sky.until(sky.sends(sky.goes_home("cf1")), 60)
    assert sky.until(jobs[2], 60)
    assert sky.airborne == 2


def test_who_waits_can_be_told_not_to() -> None:
    """Its flight is over, and it stays where it is."""
    sky = Sky([(1, 5), (5, 1)], airspace=LOW)
    sky.gives("cf1", (5, 5, 1.2))
    waits = sky.gives("cf2", (5, 5, 1.2), item=PILLS)
    sky.advance(5)
    sky.commander.break_off("cf2")
    sky.advance(40)
    assert not waits.is_set
    assert sky.navigation.flown("cf2") == 0
    home = sky.sends(sky.goes_home("cf2"))
    assert sky.until(home, 60)


def test_what_a_stopped_drone_may_still_fly_into_stays_its_own_for_a_moment() -> None:
    """A real one shoots past where it was told to stop."""
    sky = Sky([(1, 5), (3.9, 4.5)], airspace=LOW, slack=0.1)
    sky.gives("cf1", (9, 5, 1.2))
    sky.advance(4 + 4.2)
    sky.commander.break_off("cf1")
    assert sky.at("cf1") == pytest.approx((3.1, 5, 1.2))
    up = sky.gives("cf2", (3.9, 1, 1.2))
    sky.advance(1)
    assert sky.at("cf2")[2] == 0
    assert sky.until(up, 20)


def test_a_drone_that_is_found_in_the_air_has_its_place() -> None:
    """Another gateway begins from where all are."""
    sky = Sky([(1, 1), (5, 1)], airspace=LOW)
    sky.puts((5, 4, 1.2), (9, 1, 1.2))
    sky.advance(0)
    down = sky.sends(sky.commander.land("cf2"))
    assert sky.until(down, 20)
    blocked = sky.gives("cf2", (5, 4, 1.2), item=PILLS)
    assert not sky.until(blocked, 40)
    assert sky.nearest >= APART


def test_without_a_distance_nothing_is_done() -> None:
    """Each flies as if it were alone."""
    sky = Sky([(1, 5), (5, 1)], apart=0.0)
    assert sky.gateway.traffic is None
    jobs = sky.gives("cf1", (9, 5, 1.2)), sky.gives("cf2", (5, 9, 1.2))
    assert all(sky.until(job, 21) for job in jobs)
    assert sky.nearest < 0.1


def test_no_drone_flies_below_one_that_sinks() -> None:
    """Who is on its way there stops, and goes on by another, or when the air is free again."""
    sky = Sky([(5, 4), (1, 5)])
    assert sky.until(sky.gives("cf1", (5, 5, 2.2)), 60)
    hovers = sky.sends(sky.commander.hold("cf1"))
    hovers.watch(lambda _: None)
    below = sky.gives("cf2", (9, 5, 1.2))
    sky.advance(4 + 4)
    assert sky.at("cf2") == pytest.approx((3, 5, 1.2))
    sky.navigation.strike("cf1", Failure.LINK)
    nearest = APART
    while not below.is_set and sky.kernel.now < 100:
        if not sky.navigation.telemetry["cf1"].landed:
            nearest = min(nearest, dist(sky.at("cf1"), sky.at("cf2")))
        sky.advance(0.1)
    assert below.result() is None
    assert nearest == APART


@pytest.mark.parametrize(("most", "limited"), [(None, False), (2, True)])
def test_who_joins_may_fly_beside_all_others_where_no_limit_is_set(
    most: int | None, limited: bool
) -> None:
    sky = Sky([(1, 1), (4, 1)], max_airborne=most)
    traffic = sky.gateway.traffic
    assert traffic is not None
    assert not traffic.is_limited
    traffic.join(FleetDrone(id="cf3", category=ENDURING, home=(7.0, 1.0, 0.0), index=2))
    assert traffic.is_limited is limited


def test_who_hovers_too_near_to_another_already_may_fly_away_from_it() -> None:
    sky = Sky([(1, 1), (9, 9)])
    sky.puts((5, 5, 1.2), (5.3, 5, 1.2))
    assert sky.until(sky.gives("cf1", (1, 5, 1.2)), 30)
    assert sky.at("cf1") == (1, 5, 1.2)


def test_a_fast_drone_that_is_stopped_is_given_the_way_that_it_brakes_on() -> None:
    """At 10 m/s and 3 m/s² that are some twenty metres."""
    fast = replace(ENDURING, speed=10.0, motion=STEADY)
    sky = Sky(
        [(5, 50), (150, 5)], airspace=Airspace(size=(300, 100)), category=fast, apart=3.0, slack=0.7
    )
    sky.puts((5, 50, 10), (150, 5, 10))
    sky.gives("cf1", (290, 50, 10))
    sky.advance(8)
    traffic = sky.gateway.traffic
    assert traffic is not None
    sky.commander.break_off("cf1")
    sky.advance(0.2)
    x = sky.at("cf1")[0]

    def crosses(ahead: float) -> bool:
        way = Section("cf2", ((x + ahead, 40, 10), (x + ahead, 60, 10)), False, False)
        given = traffic.clear(way, lambda section: [section])
        traffic.rests("cf2")
        return given is not None

    assert not crosses(15.0)
    assert crosses(30.0)
    sky.advance(5)
    assert crosses(15.0)
