"""`batch_optimal` shares the free drones out among all that wait, for the shortest way together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.fleet.batch_optimal import batch_optimal
from tests.brain.fleet.standing import anyone, fleet, offer

NO_QUEUE: Any = None
"""It needs none."""


def given(goals: Sequence[float], drones: Sequence[Drone], able: Any = anyone) -> list[Any]:
    """Return the drone of each that waits for one, and why it has that."""
    return batch_optimal([offer((x, 0.0, 0.0), able) for x in goals], drones, NO_QUEUE)


def test_the_way_of_all_together_is_the_shortest() -> None:
    """The nearest for the first would be a metre away, and five metres for the second."""
    one, other = fleet((0.0, 0.0, 0.0), (4.0, 0.0, 0.0))
    assert [choice[0] for choice in given((3.0, 5.0), [one, other])] == [one, other]


def test_of_two_drones_that_are_equally_far_it_is_the_first_of_the_fleet() -> None:
    drones = fleet((0.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    why = "least total way for 1 waiting trips and 2 free drones: 1.0 m away"
    assert given([1.0], drones) == [(drones[0], why)]


def test_of_two_trips_that_are_equally_far_it_is_the_one_that_came_first() -> None:
    (only,) = fleet((1.0, 0.0, 0.0))
    first, second = given((0.0, 2.0), [only])
    assert (first[0], second) == (only, None)


def test_without_a_drone_that_is_able_they_go_without() -> None:
    assert given([0.0], []) == given([0.0], fleet((0.0, 0.0, 0.0)), lambda _: False) == [None]
    assert given([], fleet((0.0, 0.0, 0.0))) == []
