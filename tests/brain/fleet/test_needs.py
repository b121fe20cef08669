"""What the requests need of a drone at least: found without a look at all, and the same as with one."""

from __future__ import annotations

from math import inf

from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Drone, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT, Motion
from pluto_fleet.shared.fleet.policies import first
from pluto_fleet.shared.fleet.queue import Needs, Request
from pluto_fleet.shared.fleet.reach import Reach
from tests.brain.fleet.standing import known
from tests.kit import apps

PLAIN = Airspace(size=(30.0, 30.0))
WALLED = Airspace(size=(30.0, 30.0), no_fly=(((8, 5), (9, 5), (9, 25), (8, 25)),))

coordinate = st.floats(0, 30)
goals = st.tuples(coordinate, coordinate, st.floats(0, 10))
docks = st.tuples(coordinate, coordinate, st.just(0.0))


def drone(kind: Category, home: Point, place: Point) -> Drone:
    return Drone(id="cf1", category=kind, home=home, telemetry=known(place, 1.0, kind.motion))


def requests(
    motion: Motion, space: Airspace, places: list[Point]
) -> tuple[Category, list[Request]]:
    app = apps.app(apps.flow(), categories=(Category(name="scout", motion=motion),))
    reach = Reach(app, space)
    return app.categories[0], [
        Request(reach, apps.mission(f"m{n}", trip), first, (0, -n))
        for n, trip in enumerate(
            apps.Trip(name="1", action="take_photo", target=place) for place in places
        )
    ]


@settings(max_examples=100, deadline=None)
@given(
    st.sampled_from((STRAIGHT, CRAZYFLIE)),
    st.sampled_from((PLAIN, WALLED)),
    st.lists(goals, min_size=1, max_size=12),
    docks,
    docks,
    st.sets(st.integers(0, 11)),
    st.floats(0.2, 1.0),
)
def test_the_least_level_is_found_without_all(
    motion: Motion,
    space: Airspace,
    places: list[Point],
    home: Point,
    here: Point,
    gone: set[int],
    level: float,
) -> None:
    """Whatever has been asked before, and whichever have got a drone since."""
    kind, asked = requests(motion, space, places)
    one = drone(kind, home, here)
    assert all(request.at_least(one, here) <= request.level(one, here) for request in asked)
    arrived = asked[: len(asked) // 2]
    needs = Needs(one, arrived)
    needs.least(level)
    arrived += asked[len(asked) // 2 :]
    for number in gone & set(range(len(asked))):
        asked[number].is_set = True
    left = [request for request in asked if not request.is_set]
    least = min((request.level(one, here) for request in left), default=inf)
    assert needs.least(level) == (least if least <= level else inf)
    assert needs.least() == least
