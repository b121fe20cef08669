"""`batch_optimal` shares the free drones out among all that wait, for the shortest way together."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.model import Drone, Point
from pluto_fleet.shared.fleet.batch_optimal import batch_optimal as asked
from pluto_fleet.shared.fleet.policies import Able
from tests.brain.fleet.standing import fleet, offer


def batch_optimal(offers: Any, drones: Sequence[Drone]) -> Any:
    """Ask it; it needs no queue."""
    queue: Any = None
    return asked(offers, drones, queue)


PLACE = st.tuples(st.integers(0, 9).map(float), st.integers(0, 9).map(float), st.just(0.0))


def shared(
    drones: list[Drone], goals: list[Point], able: set[tuple[int, int]]
) -> tuple[int, float]:
    """Share the drones out; return how many go without, and the way of the others."""

    def asks(index: int) -> Able:
        return lambda drone: (index, drone.index) in able

    offers = [offer(goal, asks(index)) for index, goal in enumerate(goals)]
    choices = batch_optimal(offers, drones)
    given = [(n, choice[0]) for n, choice in enumerate(choices) if choice is not None]
    assert len({drone.index for _, drone in given}) == len(given), "no drone twice"
    assert all((n, drone.index) in able for n, drone in given)
    return len(goals) - len(given), sum(drone.distance(goals[n]) for n, drone in given)


@settings(max_examples=60)
@given(
    st.lists(PLACE, min_size=1, max_size=4),
    st.lists(PLACE, min_size=1, max_size=4),
    st.sets(st.tuples(st.integers(0, 3), st.integers(0, 3))),
)
def test_as_many_as_can_be_get_a_drone_and_their_way_is_the_shortest(
    places: list[Point], goals: list[Point], refused: set[tuple[int, int]]
) -> None:
    """Of all ways to give the drones away."""
    drones = fleet(*places)
    able = {(n, d.index) for n in range(len(goals)) for d in drones} - refused
    ways = permutations([*drones, *[None] * len(goals)], len(goals))
    allowed = [
        way for way in ways if all(d is None or (n, d.index) in able for n, d in enumerate(way))
    ]
    least = min(
        (way.count(None), sum(d.distance(goals[n]) for n, d in enumerate(way) if d is not None))
        for way in allowed
    )
    without, way = shared(drones, goals, able)
    assert without == least[0]
    assert way == pytest.approx(least[1])


def test_of_two_drones_that_are_equally_far_it_is_the_first_of_the_fleet() -> None:
    drones = fleet((0.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    why = "least total way for 1 waiting trips and 2 free drones: 1.0 m away"
    assert batch_optimal([offer((1.0, 0.0, 0.0))], drones) == [(drones[0], why)]


def test_of_two_trips_that_are_equally_far_it_is_the_one_that_came_first() -> None:
    (only,) = fleet((1.0, 0.0, 0.0))
    first, second = batch_optimal([offer((x, 0.0, 0.0)) for x in (0.0, 2.0)], [only])
    assert first is not None
    assert (first[0], second) == (only, None)


def test_without_drones_all_go_without() -> None:
    assert batch_optimal([offer((0.0, 0.0, 0.0))], []) == [None]
    assert batch_optimal([], fleet((0.0, 0.0, 0.0))) == []
