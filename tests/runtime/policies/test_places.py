"""Squares answer as a look at every drone does."""

from __future__ import annotations

from math import inf
from random import Random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from plutoc_runtime.model import Drone, Point
from plutoc_runtime.policies.grid import Places
from tests.runtime.policies.fleets import closest_of, drone, fleet

NEAR = st.integers(0, 4).map(float)
ODD = st.sampled_from([0.1 * n for n in range(12)] + [1e-9, 1 / 3, 0.30000000000000004])
FAR = st.floats(-1e6, 1e6, allow_subnormal=False)
POINT = st.one_of(
    st.tuples(NEAR, NEAR, NEAR),
    st.tuples(ODD, ODD, st.just(0.0)),
    st.tuples(FAR, st.just(5.0), NEAR),
    st.tuples(FAR, FAR, FAR),
)
Asked = tuple[Point, int]
"""A goal, and every how manieth drone is able."""


def filled(drones: list[Drone], few: int) -> Places[Drone]:
    places: Places[Drone] = Places(few)
    for one in drones:
        places.add(one, one.location)
    return places


def agree(places: Places[Drone], drones: list[Drone], goal: Point, able: int) -> None:
    """Compare with what a look at every drone gives."""
    expected = closest_of((d for d in drones if d.index % able == 0), goal)
    away, found = places.closest(goal, lambda drone: drone.index % able == 0)
    if expected:
        assert (found, away) == (expected[0], expected[0].distance(goal))
    else:
        assert (found, away) == (None, inf)


@settings(max_examples=400)
@given(
    st.lists(POINT, max_size=40),
    st.lists(st.tuples(POINT, st.sampled_from([1, 2, 7, 1000])), min_size=1, max_size=4),
    st.integers(1, 4),
)
@example(points=[(1.0, 1.0, 0.0)] * 9, asked=[((1.0, 1.0, 1.0), 2)], few=2)
@example(points=[(0.0, 0.0, z) for z in range(9)], asked=[((0.0, 0.0, 4.5), 1)], few=2)
def test_the_closest_is_that_of_a_look_at_every_drone(
    points: list[Point], asked: list[Asked], few: int
) -> None:
    """In equal places, above each other, with many refused, and to goals far outside."""
    drones = fleet(*points)
    places = filled(drones, few)
    for goal, able in asked:
        agree(places, drones, goal, able)
        assert [d for _, d in places.outward(goal)] == closest_of(drones, goal)
    for one in drones:
        agree(places, drones, one.location, 1)


@settings(max_examples=150)
@given(
    st.lists(st.tuples(st.booleans(), POINT, st.integers(0, 1000)), min_size=10, max_size=80),
    st.integers(1, 4),
)
def test_drones_come_and_go(steps: list[tuple[bool, Point, int]], few: int) -> None:
    """Also to places that no square was made for."""
    here: list[Drone] = []
    places: Places[Drone] = Places(few)
    for index, (comes, point, which) in enumerate(steps):
        if comes or not here:
            here.append(drone(index, point))
            places.add(here[-1], point)
        else:
            places.remove(here.pop(which % len(here)))
        agree(places, here, point, 1)
    assert len(places) == len(here)
    assert set(places) == set(here)


@pytest.mark.parametrize("count", [90, 300, 2000])
def test_a_large_fleet_is_no_different(count: int) -> None:
    """With as many in a square as there are in use: docks, racks of docks, and one far outside."""
    random = Random(count)
    racks = [(random.uniform(0, 900), random.uniform(0, 900)) for _ in range(4)]
    places = [
        (
            (random.choice(racks)[0] + 0.25 * random.randrange(20), random.uniform(0, 900), 0.0)
            if n % 2
            else (racks[n % 4][0], racks[n % 4][1] + 0.25 * random.randrange(20), 0.5 * (n % 3))
        )
        for n in range(count)
    ]
    drones = fleet(*places, (1e5, 1e5, 0.0))
    kept = Places[Drone]()
    for one in drones:
        kept.add(one, one.location)
    for _ in range(40):
        goal = (random.uniform(-100, 1000), random.uniform(-100, 1000), 1.5)
        agree(kept, drones, goal, random.choice([1, 1, 3, 50]))
    for one in drones[: count // 2]:
        kept.remove(one)
    for _ in range(20):
        agree(kept, drones[count // 2 :], random.choice(places), 1)
