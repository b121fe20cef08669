"""The queue for drones: who is eligible, who comes first, and what is refused."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import AfterTrip, Category, Drone, Trip
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.batch_optimal import batch_optimal
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.fleet.policies import Policy, first, least_used, nearest
from tests.kit import apps

HOMES = ((0.5, 0.5, 0.0), (9.5, 0.5, 0.0), (18.5, 0.5, 0.0))


def chosen(outcome: apps.SimulationResult) -> list[str]:
    return [f"{e['mission']}:{e['drone']}" for e in apps.events(outcome, "trip.allocated")]


def fly(policy: Policy, *missions: apps.Mission) -> apps.SimulationResult:
    return apps.fly(apps.app(apps.flow(policy=policy)), *missions, on=apps.fleet(*HOMES))


@pytest.mark.parametrize(("policy", "drone"), [(nearest, "cf3"), (first, "cf1")])
def test_policies_choose_as_they_say(policy: Policy, drone: str) -> None:
    outcome = fly(policy, apps.mission("m", apps.trip("A", 17.0)))
    assert chosen(outcome) == [f"m:{drone}"]
    assert apps.events(outcome, "trip.allocated")[0]["why"]


def test_least_used_spreads_the_trips() -> None:
    trips = [apps.trip(name, 3.0) for name in "ABC"]
    assert chosen(fly(least_used, apps.mission("m", *trips))) == ["m:cf1", "m:cf2", "m:cf3"]


def test_batch_optimal_shortens_the_way_of_all_together() -> None:
    def missions() -> list[apps.Mission]:
        return [apps.mission("a", apps.trip("A", 6.0)), apps.mission("b", apps.trip("B", 9.0))]

    assert chosen(fly(nearest, *missions())) == ["a:cf2", "b:cf1"]
    assert chosen(fly(batch_optimal, *missions())) == ["a:cf1", "b:cf2"]


def test_a_policy_of_the_apps_own_is_asked_again_until_it_chooses() -> None:
    asked: list[int] = []

    def patient(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
        asked.append(len(candidates))
        return candidates[-1] if len(asked) > 1 else None

    outcome = fly(
        own_policy(patient),
        apps.mission("a", apps.trip("A", 3.0)),
        apps.mission("b", apps.trip("B", 3.0)),
    )
    assert outcome.completed
    assert chosen(outcome)[0] == "b:cf3"


@pytest.mark.parametrize("answer", ["cf1", 7])
def test_a_policy_that_names_no_candidate_is_at_fault(answer: Any) -> None:
    def wrong(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
        named: Drone = answer
        return named

    (mission,) = fly(own_policy(wrong), apps.mission("m", apps.trip("A", 3.0))).missions
    assert "must return one of the candidates or None" in mission.reason


def test_a_higher_priority_comes_first_then_arrival() -> None:
    outcome = apps.fly(
        apps.app(apps.flow()),
        apps.mission("a", apps.trip("A", 3.0)),
        apps.mission("b", apps.trip("B", 3.0)),
        apps.mission("c", apps.trip("C", 3.0, priority=5)),
    )
    assert chosen(outcome) == ["c:cf1", "a:cf1", "b:cf1"]


def test_a_priority_that_compares_with_none_keeps_no_mission_from_its_drone() -> None:
    """A hook may have left it there."""
    flow = apps.flow(within=60.0)
    assert apps.fly(apps.app(apps.flow()), *odd_ones()).completed
    ended = apps.events(apps.fly(apps.app(flow), *odd_ones()), "mission.ended")
    assert len(ended) == 6, "those that had to leave have left, and no others"


def odd_ones() -> list[apps.Mission]:
    """Return six missions, every other one of which has such a priority."""
    odd: Any = float("nan")
    trips = [apps.trip(str(n), 3.0, priority=odd if n % 2 else n) for n in range(6)]
    return [apps.mission(trip.name, trip) for trip in trips]


def test_only_a_drone_whose_category_can_do_it_gets_a_trip() -> None:
    scout = Category(name="scout", actions=frozenset({"take_photo"}))
    carrier = Category(name="carrier", actions=frozenset({"measure"}))
    outcome = apps.fly(
        apps.app(apps.flow(), categories=(scout, carrier)),
        apps.mission("m", apps.trip("A", 1.0, action="measure")),
        on=apps.fleet(*HOMES, categories=("scout", "carrier")),
    )
    assert chosen(outcome) == ["m:cf2"]


def test_a_fleet_that_loses_its_only_able_drone_fails_the_mission_with_the_reason() -> None:
    outcome = apps.fly(
        apps.app(apps.flow(attempts=0)),
        apps.mission("m", apps.trip("A", 3.0)),
        faults=Faults(crash=1.0),
    )
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "no drone of the fleet can fly trip A: 1 of 1 drones are lost"


def test_a_mission_that_waits_too_long_for_a_drone_fails() -> None:
    outcome = apps.fly(
        apps.app(apps.flow(within=10.0)),
        apps.mission("a", apps.trip("A", 10.0)),
        apps.mission("b", apps.trip("B", 3.0)),
    )
    first_mission, second = outcome.missions
    assert first_mission.status is Status.COMPLETED
    assert second.reason == "trip B had no drone within 10 s: waits for a drone (1 busy)"
    assert apps.events(outcome, "mission.ended")[0]["t"] == 10.0


def test_a_drone_too_low_for_the_next_trip_is_charged_first() -> None:
    trips = [apps.trip(str(n), 19.0, 19.0) for n in range(4)]
    outcome = apps.fly(apps.app(apps.flow()), apps.mission("m", *trips))
    assert outcome.completed
    waits = [
        float(str(launch["t"])) - float(str(end["t"]))
        for end, launch in zip(
            apps.events(outcome, "trip.completed"),
            apps.events(outcome, "trip.launched")[1:],
            strict=False,
        )
    ]
    assert max(waits) > 120.0, "it had to charge"


def test_no_more_drones_fly_at_once_than_allowed() -> None:
    missions = [apps.mission(name, apps.trip(name, 5.0)) for name in "abc"]
    outcome = apps.fly(apps.app(apps.flow()), *missions, on=apps.fleet(*HOMES, max_airborne=1))
    assert outcome.completed
    flying = 0
    for event in outcome.events:
        flying += event["event"] == "trip.launched"
        flying -= event["event"] == "drone.free"
        assert flying <= 1


@pytest.mark.parametrize("after", list(AfterTrip))
def test_drones_go_where_the_fleet_file_says(after: AfterTrip) -> None:
    outcome = apps.fly(
        apps.app(apps.flow()),
        apps.mission("m", apps.trip("A", 5.0), apps.trip("B", 6.0)),
        on=apps.fleet(after=after),
    )
    assert outcome.completed
    x = outcome.drones[0].location[0]
    assert x == pytest.approx(6.0 if after is AfterTrip.STAY else 0.5)
    assert outcome.flown["cf1"] == pytest.approx(
        {"home": 24.8, "stay": 10.3, "next": 15.8}[after.value], abs=0.01
    )


def test_a_drone_that_is_free_is_given_even_to_who_does_not_wait() -> None:
    outcome = apps.fly(apps.app(apps.flow(within=0.0)), apps.mission("m", apps.trip("A", 3.0)))
    assert outcome.completed


def test_a_drone_that_comes_free_at_the_very_limit_is_given() -> None:
    def two(within: float | None) -> apps.SimulationResult:
        return apps.fly(
            apps.app(apps.flow(within=within)),
            apps.mission("a", apps.trip("A", 3.0)),
            apps.mission("b", apps.trip("B", 3.0)),
        )

    exact = exactly_free(two(None))
    assert two(exact).completed
    assert not two(exact - 0.001).completed


def exactly_free(outcome: apps.SimulationResult) -> float:
    """When the second mission got its drone, to the last digit."""
    (second,) = outcome.missions[1].completed_trips
    return float(str(second.start_time))


def test_a_drone_on_its_way_home_after_next_counts_as_airborne() -> None:
    missions = [apps.mission("a", apps.trip("A", 3.0)), apps.mission("b", apps.trip("B", 17.0))]
    outcome = apps.fly(
        apps.app(apps.flow()),
        *missions,
        on=apps.fleet(HOMES[0], HOMES[2], after=AfterTrip.NEXT, max_airborne=1),
    )
    assert outcome.completed
    airborne: set[object] = set()
    for event in outcome.events:
        if event["event"] in ("trip.launched", "drone.returning"):
            airborne.add(event["drone"])
        elif event["event"] == "drone.free":
            airborne.discard(event["drone"])
        assert len(airborne) <= 1, event
    assert [drone.location[0] for drone in outcome.drones] == [0.5, 18.5]


def test_a_drone_that_was_not_given_is_offered_again() -> None:
    """Not only to missions that come later."""
    asked: list[list[str]] = []

    def second_thoughts(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
        asked.append([drone.id for drone in candidates])
        return candidates[0] if trip.name == "A" or len(asked) > 2 else None

    outcome = fly(
        own_policy(second_thoughts),
        apps.mission("a", apps.trip("A", 3.0)),
        apps.mission("b", apps.trip("B", 3.0)),
    )
    assert outcome.completed
    assert asked[:3] == [["cf1", "cf2", "cf3"], ["cf2", "cf3"], ["cf2", "cf3"]]


def test_candidates_come_in_the_fleets_order_in_any_order_of_coming_free() -> None:
    asked: list[list[str]] = []

    def last(trip: Trip, candidates: Sequence[Drone]) -> Drone:
        asked.append([drone.id for drone in candidates])
        return candidates[-1]

    far = apps.mission("far", *(apps.trip(str(n), 1.0) for n in range(3)))
    near = apps.mission("near", *(apps.trip(str(n), 9.0) for n in range(6)))
    assert fly(own_policy(last), far, near).completed
    assert all(ids == sorted(ids) for ids in asked)
    assert {len(ids) for ids in asked} == {1, 2, 3}


def test_a_policy_that_never_gives_a_drone_stops_the_simulation_with_the_reason() -> None:
    with pytest.raises(BadInput, match=r"gives them none of the drones \(3 free\)"):
        fly(own_policy(lambda trip, drones: None), apps.mission("a", apps.trip("A", 3.0)))
