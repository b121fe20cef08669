"""`nearest` gives the closest of the free drones that are able."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.fleet.policies import Policy, first, least_used, nearest
from tests.brain.fleet.standing import anyone, fleet, trip
from tests.kit import apps


def test_the_closest_gets_the_trip_and_it_is_said_why() -> None:
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (4.0, 0.0, 0.0))
    assert nearest(trip((7.0, 0.0, 0.0)), drones, anyone) == (
        drones[1],
        "nearest of 3 free: 2.0 m away",
    )


def test_the_distance_is_to_where_the_trip_begins() -> None:
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0))
    choice = nearest(trip((9.0, 0.0, 0.0), source=(1.0, 0.0, 0.0)), drones, anyone)
    assert choice == (drones[0], "nearest of 2 free: 1.0 m away")


def test_who_is_not_able_is_passed_over_and_counts_as_free() -> None:
    drones = fleet((0.0, 0.0, 0.0), (9.0, 0.0, 0.0))
    choice = nearest(trip((9.0, 0.0, 0.0)), drones, lambda drone: drone is drones[0])
    assert choice == (drones[0], "nearest of 2 free: 9.0 m away")
    assert nearest(trip((9.0, 0.0, 0.0)), drones, lambda drone: False) is None


def test_of_two_that_are_equally_far_it_is_the_first_of_the_fleet() -> None:
    drones = fleet((0.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    choice = nearest(trip((1.0, 0.0, 0.0)), drones, anyone)
    assert choice == (drones[0], "nearest of 2 free: 1.0 m away")


def test_a_drone_that_is_farther_away_than_an_able_one_is_not_asked() -> None:
    """To be able can take a route."""
    asked: list[str] = []

    def able(drone: Drone) -> bool:
        asked.append(drone.id)
        return True

    drones = fleet((4.0, 0.0, 0.0), (9.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    nearest(trip((0.0, 0.0, 0.0)), drones, able)
    assert asked == ["cf2"]


HOMES = ((0.5, 0.5, 0.0), (9.5, 0.5, 0.0), (18.5, 0.5, 0.0))


@pytest.mark.parametrize(
    ("policy", "drones", "why"),
    [
        (nearest, ["cf3"] * 3, "nearest of 3 free: 1.9 m away"),
        (first, ["cf1"] * 3, "first of 3 free in the fleet's order"),
        (least_used, ["cf1", "cf2", "cf3"], "least used of 3 free: 0 trips so far"),
    ],
)
def test_policies_choose_as_they_say(policy: Policy, drones: list[str], why: str) -> None:
    """Three trips, one after the other, each when all drones are at home again."""
    trips = [apps.trip(name, 17.0, delay=90.0) for name in "ABC"]
    flown = apps.flown(apps.mission("m", *trips), policy=policy, clock=True, on=apps.fleet(*HOMES))
    given = apps.events(flown, "trip.allocated")
    assert [event["drone"] for event in given] == drones
    assert given[0]["why"] == why
