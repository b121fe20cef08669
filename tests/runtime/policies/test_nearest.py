"""`nearest` gives the closest of the free drones that are able."""

from __future__ import annotations

from plutoc_runtime.policies.nearest import nearest
from tests.runtime.policies.fleets import anyone, drone, fleet, told, trip


def test_the_closest_gets_the_trip_and_it_is_said_why() -> None:
    pool = nearest()
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (4.0, 0.0, 0.0))
    for one in drones:
        pool.add(one)
    assert told(pool.choose(trip((7.0, 0.0, 0.0)), anyone)) == (
        drones[1],
        "nearest of 3 free: 2.0 m away",
    )


def test_the_distance_is_to_where_the_trip_begins() -> None:
    pool = nearest()
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0))
    for one in drones:
        pool.add(one)
    choice = told(pool.choose(trip((9.0, 0.0, 0.0), source=(1.0, 0.0, 0.0)), anyone))
    assert choice == (drones[0], "nearest of 2 free: 1.0 m away")


def test_who_is_not_able_is_passed_over_and_counts_as_free() -> None:
    pool = nearest()
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0))
    for one in drones:
        pool.add(one)
    choice = told(pool.choose(trip((9.0, 0.0, 0.0)), lambda drone: drone is drones[0]))
    assert choice == (drones[0], "nearest of 2 free: 9.0 m away")
    assert told(pool.choose(trip((9.0, 0.0, 0.0)), lambda drone: False)) is None


def test_of_two_that_are_equally_far_it_is_the_first_of_the_fleet() -> None:
    """In whatever order they came free."""
    pool = nearest()
    late, early = drone(5, (2.0, 0.0, 0.0)), drone(1, (0.0, 0.0, 0.0))
    pool.add(late)
    pool.add(early)
    assert told(pool.choose(trip((1.0, 0.0, 0.0)), anyone)) == (
        early,
        "nearest of 2 free: 1.0 m away",
    )


def test_a_drone_that_is_given_away_is_not_given_again() -> None:
    pool = nearest()
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0))
    for one in drones:
        pool.add(one)
    pool.remove(drones[0])
    assert told(pool.choose(trip((0.0, 0.0, 0.0)), anyone)) == (
        drones[1],
        "nearest of 1 free: 9.0 m away",
    )
    pool.remove(drones[1])
    assert told(pool.choose(trip((0.0, 0.0, 0.0)), anyone)) is None
