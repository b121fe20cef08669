"""The bounds of what a trip takes of a battery: true for every motion, category and map."""

from __future__ import annotations

from math import inf

from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Drone, Item, Point
from pluto_fleet.shared.domain.motion import Motion
from pluto_fleet.shared.fleet.needs import Request
from pluto_fleet.shared.fleet.policies import first
from pluto_fleet.shared.fleet.reach import MORE, Reach
from pluto_fleet.shared.fleet.telemetry import Charge, KnownState, resting
from tests.kit import apps

seconds = st.floats(0, 5)
motions = st.builds(
    Motion,
    legs=st.sampled_from(("straight", "smooth")),
    limit=st.floats(0.05, 100),
    take_off=seconds,
    settles=seconds,
    landing=seconds,
    pace=st.floats(0.1, 3),
    drain=st.floats(0.1, 3),
)
categories = st.builds(
    Category,
    name=st.just("scout"),
    speed=st.floats(0.05, 50),
    flight_time=st.floats(10, 1e5),
    reserve=st.floats(0, 0.9),
    actions=st.none() | st.just(frozenset({"measure"})),
    motion=motions,
)
WALL = ((8.0, 5.0), (9.0, 5.0), (9.0, 15.0), (8.0, 15.0))
spaces = st.builds(
    Airspace,
    size=st.tuples(st.floats(1, 1000), st.floats(1, 1000)),
    cruise_height=st.floats(0.1, 12),
    no_fly=st.just(()) | st.just((WALL,)),
)
part = st.floats(-0.01, 1.01) | st.sampled_from((0.0, 1.0))
places = st.tuples(part, part, st.floats(-0.1, 11))
sources = st.none() | places
docks = st.tuples(part, part, st.sampled_from((0.0, 0.0, 0.5)))
items = st.none() | st.builds(Item, name=st.just("box"), mass=st.floats(0, 0.02))
actions = st.sampled_from(("take_photo", "pick_item"))


class Clock:
    now = 0.0


def told(place: Point, level: float, motion: Motion) -> KnownState:
    state = KnownState(Clock(), place, motion)
    state._legs, state._charge = [resting(place, 0.0)], Charge(level, 0.0)
    return state


@settings(max_examples=300, deadline=None)
@given(categories, spaces, places, sources, items, actions, docks, docks, st.booleans())
def test_the_exact_level_is_between_its_bounds(
    kind: Category,
    space: Airspace,
    target: Point,
    source: Point | None,
    item: Item | None,
    action: str,
    home: Point,
    away: Point,
    stands_at_home: bool,
) -> None:
    """And a drone is able just if it has the exact level, by whichever bound that is found."""

    def on_map(place: Point) -> Point:
        return place[0] * space.size[0], place[1] * space.size[1], place[2]

    app = apps.app(apps.flow(), categories=(kind,))
    (kind,), reach, home = app.categories, Reach(app, space), on_map(home)
    here = home if stands_at_home else on_map(away)
    source = source and on_map(source)
    trip = apps.Trip(name="1", action=action, target=on_map(target), source=source, item=item)
    drone = Drone(id="cf1", category=kind, home=home, telemetry=told(here, 1.0, kind.motion))
    reach.drones = [drone]
    request = Request(reach, apps.mission("m", trip), first, (0, -1))
    exact = reach.level(kind, home, here, [trip])
    least = request.at_least(drone, here)
    assert least <= exact
    _, _, slack, anywhere = reach.bounds(action, trip.target, source is None and item is None)[kind]
    if here == home:
        assert exact <= least * MORE + slack <= anywhere
    wanted = request.level(drone)
    assert (request.never(drone) is None) == (reach.level(kind, home, home, [trip]) <= 1.0)
    for level in {0.0, 0.5, 1.0, *(one for one in (exact, least) if one < inf)}:
        drone.telemetry = told(here, level, kind.motion)
        if level <= 1.0:
            assert request.able(drone) == (level >= wanted)


@given(categories, st.floats(0, 1e4))
def test_a_short_leg_takes_little_more_than_its_share_of_a_long_one(
    kind: Category, metres: float
) -> None:
    motion, speed = kind.motion, kind.speed
    share = metres * motion.leg(1e6, speed) / 1e6
    assert share * (1 - 1e-12) <= motion.leg(metres, speed)
    assert motion.leg(metres, speed) <= (share + motion.shortness(speed)) * (1 + 1e-12)
