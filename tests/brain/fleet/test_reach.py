"""The arithmetic of flights: seconds, shares of a battery, and who is able to fly a trip."""

from __future__ import annotations

from dataclasses import asdict, replace
from math import inf
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.alone.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.model import Category, Drone, Item, Point
from pluto_fleet.shared.domain.motion import Motion
from pluto_fleet.shared.fleet.policies import first
from pluto_fleet.shared.fleet.queue import Request
from pluto_fleet.shared.fleet.reach import Reach, docked, flight_seconds, grip_problem, needed
from tests.brain.fleet.standing import known
from tests.brain.hand import settled
from tests.kit import apps

SCOUT = Category(name="scout", speed=0.5, flight_time=420)
WALL = Airspace(no_fly=(((8, 0), (9, 0), (9, 20), (8, 20)),))


def test_where_no_way_leads_takes_for_ever() -> None:
    """Behind a wall without an end there is nothing to wait for."""
    assert flight_seconds(SCOUT, WALL, (1, 1, 0), [(15, 1, 1.2)], 0) == inf
    assert needed(SCOUT, WALL, (1, 1, 0), [((15, 1, 1.2), 1)], (1, 1, 0)) == inf


def test_a_drone_that_drifts_out_of_the_map_still_has_a_way() -> None:
    """A position is measured: under a ceiling as high as it flies, half of them are above it."""
    low = Airspace(cruise_height=15.0, ceiling=15.0)
    at_home = [(5.0, 1.0, 0.0)]
    inside = flight_seconds(SCOUT, low, (1.0, 1.0, 15.0), at_home, 0)
    assert flight_seconds(SCOUT, low, (1.0, 1.0, 15.00003), at_home, 0) == pytest.approx(
        inside, abs=0.01
    )
    assert inside < flight_seconds(SCOUT, low, (-2.0, 1.0, 15.0), at_home, 0) < inf


def test_a_dock_charges_who_lands_near_enough() -> None:
    """Twenty centimetres are near enough, at any height that home was written with."""
    assert docked((1.1, 1.1, 0), (1, 1, 0.5))
    assert not docked((1.2, 1.1, 0), (1, 1, 0))


# The promise: a drone gets a trip just if its battery lasts there, for the action, and home, with its reserve left

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
    charge_time=st.just(1e9),
    reserve=st.floats(0, 0.9),
    actions=st.none() | st.just(frozenset({"measure"})),
    motion=motions,
)
FENCE = ((8.0, 5.0), (9.0, 5.0), (9.0, 15.0), (8.0, 15.0))
spaces = st.builds(
    Airspace,
    size=st.tuples(st.floats(1, 1000), st.floats(1, 1000)),
    cruise_height=st.floats(0.1, 9),
    no_fly=st.just(()) | st.just((FENCE,)),
)
part = st.floats(-0.01, 1.01) | st.sampled_from((0.0, 1.0))
places = st.tuples(part, part, st.floats(-0.1, 11))
docks = st.tuples(part, part, st.sampled_from((0.0, 0.0, 0.5)))


def on_map(space: Airspace, place: Point) -> Point:
    return place[0] * space.size[0], place[1] * space.size[1], place[2]


def left_after(kind: Category, space: Airspace, trip: apps.Trip, home: Point) -> float | None:
    """Return what a flight leaves of a full battery, as ideal drones fly it; None: none can fly it."""
    given: Any = apps.app(apps.flow(), categories=(replace(kind, reserve=0.0),)).given
    on = replace(apps.fleet(home, airspace=space), motion=kind.motion, world=WorldData())
    mission = apps.mission("m", trip)
    flown = simulate(
        given, [mission], on, seed=0, faults=Faults(), until=None, on_event=None
    ).standing
    completed = flown["missions"]["m"]["status"] == "COMPLETED"
    return float(flown["drones"]["cf1"]["battery"]) if completed else None


def gets_it(kind: Category, space: Airspace, trip: apps.Trip, home: Point, level: float) -> bool:
    """Return whether a drone with this battery is told to fly the trip."""
    given: Any = apps.app(apps.flow(), categories=(kind,)).given
    fleet = {"drones": [{"id": "cf1", "home": home}], "motion": asdict(kind.motion)}
    brain = Brain(given, fleet, space=space)
    brain.tell({"telemetry": {"cf1": {"at": (*home[:2], 0.0), "battery": level}}}, 0.0)
    brain.begin([{"trips": [{"action": trip.action, "target": trip.target}]}], 0.0)
    orders = settled(brain, 0.0)
    brain.close()
    return any(order["do"] == "fly" for order in orders)


@settings(max_examples=40)
@given(categories, spaces, st.tuples(part, part, st.floats(0.1, 9)), docks)
def test_a_drone_gets_a_trip_just_if_its_battery_lasts(
    kind: Category, space: Airspace, target: Point, home: Point
) -> None:
    """As much as the flight takes, and its reserve; a billionth less is too little."""
    kind = replace(kind, actions=None)
    trip = apps.Trip(name="1", action="take_photo", target=on_map(space, target))
    home = on_map(space, home)
    assume(not space.problem(trip.target) and not space.problem(home))
    left = left_after(kind, space, trip, home)
    assume(left is not None)
    # it drains only from when it leaves the ground, and is charged from its touch-down on, before it counts as landed
    spared = kind.motion.take_off + kind.motion.landing
    wanted = 1.0 - float(left or 0.0) + kind.reserve + spared / kind.endurance
    assert not gets_it(kind, space, trip, home, min(1.0, wanted - 1e-6))
    if wanted <= 1.0 - 1e-6:
        assert gets_it(kind, space, trip, home, wanted + 1e-6)


@settings(max_examples=150)
@given(
    categories,
    spaces,
    places,
    st.none() | places,
    st.none() | st.builds(Item, name=st.just("box"), mass=st.floats(0, 0.02)),
    st.sampled_from(("take_photo", "pick_item")),
    docks,
    st.none() | docks,
)
def test_who_is_able_is_found_the_same_without_a_look_at_the_map(
    kind: Category,
    space: Airspace,
    target: Point,
    source: Point | None,
    item: Item | None,
    action: str,
    home: Point,
    away: Point | None,
) -> None:
    """Wherever it stands, by whichever bound: just those that have the level which the exact way takes."""
    app = apps.app(apps.flow(), categories=(kind,))
    (kind,), reach, home = app.categories, Reach(app, space), on_map(space, home)
    here = home if away is None else on_map(space, away)
    begins = source and on_map(space, source)
    trip = apps.Trip(
        name="1", action=action, target=on_map(space, target), source=begins, item=item
    )
    drone = Drone(id="cf1", category=kind, home=home, telemetry=known(here, 1.0, kind.motion))
    request = Request(reach, apps.mission("m", trip), first, (0, -1))
    exact, from_home = (reach.level(kind, home, place, [trip]) for place in (here, home))
    assert request.at_least(drone, here) <= exact
    assert (request.never(drone) is None) == request.ever(drone) == (from_home <= 1.0)
    for level in {0.0, 0.5, 1.0, exact, request.at_least(drone, here)}:
        if level <= 1.0:
            drone.telemetry = known(here, level, kind.motion)
            assert request.able(drone) == (level >= exact and from_home <= 1.0)


BOX, OTHER = Item(name="box", mass=0.004), Item(name="vial", mass=0.001)


@pytest.mark.parametrize(
    ("aboard", "action", "item", "why"),
    [
        (None, "pick_item", BOX, None),
        (BOX, "release_item", BOX, None),
        (BOX, "take_photo", None, None),
        (None, "pick_item", None, "there is nothing to pick"),
        (OTHER, "pick_item", BOX, "cf1 already carries vial"),
        (None, "pick_item", Item(name="box", mass=0.01), None),
        (
            None,
            "pick_item",
            Item(name="box", mass=0.0101),
            "box weighs 10.1 g, cf1 carries at most 10 g",
        ),
        (None, "release_item", BOX, "cf1 carries nothing, not box"),
        (OTHER, "release_item", BOX, "cf1 carries vial, not box"),
        (OTHER, "release_item", None, "cf1 carries vial"),
    ],
)
def test_a_grip_fails_for_a_reason(
    aboard: Item | None, action: str, item: Item | None, why: str | None
) -> None:
    assert grip_problem("cf1", SCOUT, aboard, action, item) == why
