"""Where another drone has the place of an action, it is done beside that, at the same time."""

from __future__ import annotations

from itertools import combinations
from math import dist

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.gateway.traffic.beside import FURTHEST, places_above, places_around, to_beside
from pluto_fleet.gateway.traffic.legs import leg_problem
from pluto_fleet.gateway.traffic.ways import Section
from pluto_fleet.jobs.flown import BESIDE
from pluto_fleet.shared.domain.actions import PHOTO
from pluto_fleet.shared.domain.airspace import Airspace, Polygon
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.library.gateway.flights import Task as Job
from tests.library.gateway.traffic.skies import Sky

SPOT: Point = (5.0, 5.0, 1.2)
DOCKS = [(1.0 + i, 1.0) for i in range(9)]
WALL: Polygon = ((4.0, 5.2), (6.0, 5.2), (6.0, 5.4), (4.0, 5.4))
OPEN, LOW = Airspace(), Airspace(ceiling=1.3)
WALLED = Airspace(no_fly=(WALL,))
CORNER = Airspace(size=(10.0, 5.0))


@pytest.mark.parametrize("slack", [0.0, CRAZYFLIE.slack])
@pytest.mark.parametrize("count", [2, 3, 5])
def test_some_at_one_spot_take_hardly_longer_than_one(count: int, slack: float) -> None:
    """Each is nowhere nearer to another than it may be, and at the height of the target."""
    alone = Sky(DOCKS, slack=slack)
    assert alone.until(alone.gives("cf1", SPOT), 60)
    sky = Sky(DOCKS, slack=slack)
    jobs = [sky.gives(f"cf{n + 1}", SPOT) for n in range(count)]
    assert all(sky.until(job, 60) for job in jobs)
    assert sky.kernel.now <= 1.25 * alone.kernel.now
    places = [sky.at(f"cf{n + 1}") for n in range(count)]
    assert places[0] == SPOT
    assert all(place[2] == SPOT[2] for place in places)
    assert min(dist(a, b) for a, b in combinations(places, 2)) >= sky.apart + slack - 1e-6
    assert max(dist(place, SPOT) for place in places) <= FURTHEST * sky.gateway.traffic.level + 1e-6  # type: ignore[union-attr]
    assert sky.nearest >= sky.apart + slack - 1e-6


def test_it_is_told_where_an_action_is_done_beside_its_target() -> None:
    """With the flight that it is done for, and not of the one that has the place."""
    sky = Sky(DOCKS[:2])
    told = sky.commander.flown
    jobs = [sky.gives("cf1", SPOT), sky.gives("cf2", SPOT)]
    assert all(sky.until(job, 60) for job in jobs)
    [one] = told
    place = [round(along, 3) for along in sky.at("cf2")]
    assert one == {
        "drone": "cf2",
        "what": BESIDE,
        "flight": "2",
        "target": [*SPOT],
        "at": place,
    }
    assert dist(place, SPOT) == pytest.approx(sky.apart, abs=1e-3)


def test_a_brain_that_comes_while_the_action_is_done_is_told_once_more() -> None:
    """The one before may have died before it could write it down."""
    sky = Sky(DOCKS[:2])
    assert sky.until(sky.gives("cf1", SPOT), 60)
    first = sky.commander.flown
    photo = Job(id="M/A/0/1", drone="cf2", stops=(SPOT,), action=PHOTO, item=None, beside=True)
    sky.commander.fly(photo, lambda _: None)
    while not first:
        sky.advance(0.1)
        assert sky.kernel.now < 120
    sky.commander = sky.link(2)
    second = sky.commander.flown
    reported = list[object]()
    there = sky.sends(sky.commander.fleet_report())
    assert sky.until(there, 1)
    sky.commander.attach("M/A/0/1", reported.append)
    sky.advance(2)
    assert second == first
    assert len(reported) == 1
    sky.commander.forget("M/A/0/1")
    sky.commander.attach("M/A/0/1", reported.append)
    assert second == first


def test_who_only_passes_through_a_place_does_not_have_it() -> None:
    """The other waits for a moment, and acts just where it was told to."""
    sky = Sky([(1.0, 5.0), (5.0, 1.0)], airspace=LOW)
    told = sky.commander.flown
    jobs = [sky.gives("cf1", (9.0, 5.0, 1.2)), sky.gives("cf2", SPOT)]
    assert all(sky.until(job, 60) for job in jobs)
    assert sky.at("cf2") == SPOT
    assert told == []


def test_where_the_place_is_taken_only_in_part_it_is_done_as_near_as_can_be() -> None:
    """The other hovers 30 cm beside: 25 cm to the other side are enough."""
    sky = Sky([(5.0, 1.0), (5.0, 9.0)])
    assert sky.until(sky.gives("cf1", (5.0, 4.7, 1.2)), 60)
    assert sky.until(sky.gives("cf2", SPOT), 60)
    assert dist(sky.at("cf2"), SPOT) == pytest.approx(0.25)
    assert sky.nearest >= sky.apart - 1e-6


def test_nothing_forbidden_is_between_a_target_and_the_place_beside_it() -> None:
    """What is behind a wall cannot be seen from there."""
    sky = Sky(DOCKS, airspace=WALLED)
    jobs = [sky.gives(f"cf{n + 1}", SPOT) for n in range(4)]
    assert all(sky.until(job, 90) for job in jobs)
    for n in range(4):
        assert leg_problem(WALLED, SPOT, sky.at(f"cf{n + 1}")) is None
    assert sky.nearest >= sky.apart - 1e-6


def test_where_the_map_leaves_no_place_around_there_is_one_above() -> None:
    """In a shaft as narrow as one drone."""
    shaft: tuple[Polygon, ...] = (
        ((3.0, 3.0), (4.8, 3.0), (4.8, 7.0), (3.0, 7.0)),
        ((5.2, 3.0), (7.0, 3.0), (7.0, 7.0), (5.2, 7.0)),
        ((4.8, 5.2), (5.2, 5.2), (5.2, 7.0), (4.8, 7.0)),
    )
    airspace = Airspace(no_fly=shaft)
    sky = Sky([(5.0, 1.0), (6.0, 1.0), (7.0, 1.0), (8.0, 1.0)], airspace=airspace)
    for n in range(4):
        assert sky.until(sky.gives(f"cf{n + 1}", SPOT), 90)
    places = [sky.at(f"cf{n + 1}") for n in range(4)]
    assert places[0] == SPOT
    assert dist(places[1], SPOT) == pytest.approx(sky.apart)
    assert [place[2] for place in places[:2]] == [SPOT[2]] * 2
    assert places[3] == pytest.approx((5.0, 5.0, SPOT[2] + sky.apart))
    assert sky.nearest >= sky.apart - 1e-6


@given(
    x=st.floats(0, 10),
    y=st.floats(0, 5),
    z=st.floats(0.3, 1.3),
    step=st.floats(0.05, 3.0),
    angle=st.floats(-4.0, 4.0),
    airspace=st.sampled_from([LOW, WALLED, CORNER]),
)
def test_places_are_permitted_and_the_nearest_come_first(
    x: float, y: float, z: float, step: float, angle: float, airspace: Airspace
) -> None:
    """None is farther away than is promised."""
    target = (x, y, z)
    around = places_around(target, step, airspace, angle)
    far = [dist(place, target) for place in around]
    assert far == pytest.approx(sorted(far))
    assert max(far, default=0.0) <= FURTHEST * step + 1e-6
    above = [*places_above(target, step, airspace)]
    assert all(place[:2] == (x, y) and z < place[2] <= airspace.ceiling + 1e-6 for place in above)
    if airspace.problem(target) is None:
        for place in (*around, *above):
            assert airspace.problem(place) is None
            assert leg_problem(airspace, target, place) is None


AROUND = Section("cf1", ((5.0, 8.0, 1.2), (6.3, 5.2, 1.2), SPOT), False, False)
"""A way past the wall's right end."""


def test_a_way_beside_differs_in_its_last_leg() -> None:
    """So no route is searched for each of many places, while other drones fly."""
    place = (5.5, 4.9, 1.2)
    way = to_beside(AROUND, place, WALLED)
    assert way is not None
    assert way.points == (*AROUND.points[:-1], place)
    assert way.target == SPOT
    assert to_beside(AROUND, (3.9, 5.3, 1.2), WALLED) is None, "the wall is on its last leg"
