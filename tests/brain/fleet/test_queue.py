"""The queue for drones: who comes first, who is charged for whom, and what is refused."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from random import Random
from typing import Any

import pytest

from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.report.report import exit_code
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import AfterTrip, Category, Drone, Trip
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.least_makespan import least_makespan
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.fleet.policies import Policy, first, least_used, nearest
from pluto_fleet.shared.fleet.queue import Request
from tests.kit import apps

HOMES = ((0.5, 0.5, 0.0), (9.5, 0.5, 0.0), (18.5, 0.5, 0.0))
THREE = apps.fleet(*HOMES)
TIRED = Category(name="scout", flight_time=100.0, charge_time=400.0)
"""A flight of twenty seconds takes a fifth of its battery."""


def chosen(outcome: apps.SimulationResult) -> list[str]:
    return [f"{e['mission']}:{e['drone']}" for e in apps.events(outcome, "trip.allocated")]


def missions(*names: str, x: float = 3.0, **more: Any) -> list[apps.Mission]:
    """Return missions of one trip each."""
    return [apps.mission(name, apps.trip(name.upper(), x, **more)) for name in names]


# Who comes first


def test_one_that_comes_later_goes_before_those_of_a_lower_priority() -> None:
    late = missions("late", x=2.0, priority=1, delay=5.0)
    flown = apps.flown(*missions("a", "b", "c"), *late, clock=True)
    assert chosen(flown) == ["a:cf1", "late:cf1", "b:cf1", "c:cf1"]


def test_a_priority_that_compares_with_none_keeps_no_mission_from_its_drone() -> None:
    """A hook may have left it there."""

    def odd_ones() -> list[apps.Mission]:
        odd: Any = float("nan")
        trips = [apps.trip(str(n), 3.0, priority=odd if n % 2 else n) for n in range(6)]
        return [apps.mission(trip.name, trip) for trip in trips]

    assert apps.flown(*odd_ones()).completed
    ended = apps.events(apps.flown(*odd_ones(), within=60.0), "mission.ended")
    assert len(ended) == 6, "those that had to leave have left, and no others"


def test_only_a_drone_whose_category_can_do_it_gets_a_trip() -> None:
    scout = Category(name="scout", actions=frozenset({"take_photo"}))
    carrier = Category(name="carrier", actions=frozenset({"measure"}))
    on = apps.fleet(*HOMES, categories=("scout", "carrier"))
    flown = apps.flown(*missions("m", x=1.0, action="measure"), categories=(scout, carrier), on=on)
    assert chosen(flown) == ["m:cf2"]


def test_who_can_be_served_is_served_though_those_before_it_cannot() -> None:
    """The first wait for the carrier; the scouts fly past them, in the order in which they came."""
    scout = Category(name="scout", actions=frozenset({"take_photo"}))
    carrier = Category(name="carrier", actions=frozenset({"measure"}))
    on = apps.fleet(*HOMES, categories=("scout", "carrier", "scout"))
    waiting = [*missions(*"abcdef", action="measure"), *missions(*"xyz")]
    flown = apps.flown(*waiting, categories=(scout, carrier), on=on)
    assert sorted(chosen(flown)[:3]) == ["a:cf2", "x:cf1", "y:cf3"]
    served = [one[0] for one in chosen(flown)]
    assert [one for one in served if one in "abcdef"] == [*"abcdef"]
    assert [one for one in served if one in "xyz"] == [*"xyz"]


# What is refused


def test_a_fleet_that_loses_its_only_able_drone_fails_the_mission_with_the_reason() -> None:
    flown = apps.flown(*missions("a"), attempts=0, faults=Faults(crash=1.0))
    (mission,) = flown.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "no drone of the fleet can fly trip A: 1 of 1 drones are lost"


def test_who_waits_for_a_drone_that_is_lost_then_is_told_at_once() -> None:
    """Also one that has been waiting since before; what others could fly is flown."""
    scout = Category(name="scout", actions=frozenset({"take_photo"}))
    carrier = Category(name="carrier", actions=frozenset({"measure"}))
    on = apps.fleet(*HOMES[:2], categories=("scout", "carrier"))
    flown = apps.flown(
        *missions("a", "b", action="measure"),
        *missions("c"),
        categories=(scout, carrier),
        on=on,
        faults=Faults(crash=1.0),
    )
    ended, lost = apps.moments(flown, "mission.ended"), apps.times(flown, "drone.lost")
    assert ended["b"] in lost
    assert flown.missions[1].reason == (
        "no drone of the fleet can fly trip B: 1 of 2 drones are lost; scout cannot measure"
        if ended["b"] == lost[0]
        else "no drone of the fleet can fly trip B: 2 of 2 drones are lost"
    )


def test_what_no_drone_can_reach_is_refused_as_it_is_asked_for() -> None:
    near, far = missions("a")[0], apps.mission("far", apps.trip("F", 19.0, 19.0))
    weak = Category(name="scout", flight_time=60.0)
    flown = apps.flown(near, far, categories=(weak,))
    assert flown.missions[0].status is Status.COMPLETED
    assert flown.missions[1].reason.startswith("no drone of the fleet can fly trip F: scout would")
    assert apps.moments(flown, "mission.ended")["far"] == 0.0


@pytest.mark.parametrize("on", [THREE, replace(THREE, apart=0.0)])
@pytest.mark.parametrize("until", [None, 60.0])
def test_a_simulation_whose_policy_never_gives_a_drone_is_given_up_with_the_reason(
    on: FleetFile, until: float | None
) -> None:
    """Its end is a result like others: missions, JSON and exit code 1."""
    policy = own_policy(lambda trip, drones: None)
    outcome = apps.flown(*missions("a"), policy=policy, on=on, until=until)
    assert "the policy gives them none of the drones (3 free)" in outcome.given_up
    assert outcome.missions[0].status is Status.UNEXECUTED
    assert exit_code(outcome) == 1


# Drones that are too low


def pauses(flown: apps.SimulationResult) -> list[float]:
    """Return for how long the only drone stood at home between two flights."""
    homes, launches = apps.times(flown, "drone.free"), apps.times(flown, "trip.launched")
    return [next(t for t in [*launches, 1e9] if t >= home) - home for home in homes[:-1]]


def test_a_drone_is_charged_for_its_share_of_those_that_wait_and_not_for_the_next_one_alone() -> (
    None
):
    """A full battery lasts for three flights: it is full again after these, and then has enough for two."""
    flown = apps.flown(*missions(*"abcdefgh", x=3.6), categories=(TIRED,))
    assert flown.completed
    assert [round(pause) for pause in pauses(flown)] == [0, 0, 257, 0, 0, 108, 0]


def test_the_share_is_that_of_one_of_all_drones() -> None:
    """Of four that wait each of two drones charges for two."""
    flown = apps.flown(*missions(*"abcdefghij", x=3.6), categories=(TIRED,), on=apps.TWO)
    assert flown.completed
    launches = sorted(apps.times(flown, "trip.launched"))
    (pause,) = [b - a for a, b in pairwise(launches) if b - a > 30.0]
    assert 100.0 < pause < 130.0, "to be full takes 257 s, and the next flight alone 23 s"


@pytest.mark.parametrize(
    "urgent", [{"priority": 1}, {}], ids=["a higher priority", "a trip that it can fly already"]
)
def test_a_drone_that_charges_for_others_is_there_for_what_it_suffices_for(
    urgent: dict[str, Any],
) -> None:
    """A new trip, near enough, is flown at once; the others wait on."""
    far = apps.mission("far", *(apps.trip(str(n), 19.0, 10.0) for n in range(2)))
    new = apps.mission("new", apps.trip("N", 1.0, delay=130.0, **urgent))
    flown = apps.flown(
        far, new, categories=(Category(name="scout", flight_time=160.0),), clock=True
    )
    assert flown.completed
    assert [e["mission"] for e in apps.events(flown, "trip.launched")] == ["far", "new", "far"]
    assert apps.moments(flown, "trip.launched")["new"] == 130.0


def test_a_low_drone_in_the_field_goes_home_to_charge_for_who_waits() -> None:
    trips = [apps.trip(str(n), 15.0 - n) for n in range(5)]
    on = apps.fleet(after=AfterTrip.STAY)
    flown = apps.flown(apps.mission("m", *trips), on=on, categories=(TIRED,))
    assert flown.completed
    assert flown.count("drone.returning") > 0


def test_a_low_drone_is_fetched_if_it_could_fly_any_of_those_that_wait() -> None:
    """Though another of them is not for it."""
    kinds = (
        Category(
            name="scout", flight_time=100.0, charge_time=100.0, actions=frozenset({"take_photo"})
        ),
        Category(name="carrier", flight_time=1_000.0, actions=frozenset({"measure"})),
    )
    on = apps.fleet(*HOMES[:2], categories=("scout", "carrier"), after=AfterTrip.STAY)
    photos = apps.mission("p", apps.trip("1", 9.0), apps.trip("2", 15.0), apps.trip("3", 9.0))
    measures = [
        apps.mission(name, apps.trip("1", x, 19.0, action="measure"))
        for name, x in zip("abcdef", (19.0, 1.0) * 3, strict=True)
    ]
    flown = apps.flown(photos, *measures, categories=kinds, on=on)
    assert flown.completed
    fetched = [
        event["t"] for event in apps.events(flown, "drone.returning") if event["drone"] == "cf1"
    ]
    assert float(str(fetched[0])) < apps.moments(flown, "trip.launched")["f"]


# The room in the air


def airborne(flown: apps.SimulationResult) -> int:
    """Return how many drones were in the air at once, at most."""
    now, most = set[object](), 0
    for event in flown.events:
        if event["event"] in ("trip.launched", "drone.returning", "drone.recovering"):
            now.add(event["drone"])
        elif event["event"] in ("drone.free", "drone.charging"):
            now.discard(event["drone"])
        most = max(most, len(now))
    return most


@pytest.mark.parametrize("after", AfterTrip)
@pytest.mark.parametrize("most", [1, 2])
def test_no_more_drones_fly_at_once_than_allowed(after: AfterTrip, most: int) -> None:
    """Those on their way home count."""
    on = apps.fleet(*HOMES, after=after, max_airborne=most)
    flown = apps.flown(*missions(*"abcde", x=5.0), *missions("z", x=17.0), on=on)
    assert flown.completed
    assert airborne(flown) == most


@pytest.mark.parametrize(
    ("after", "x", "metres"),
    [("home", 0.5, 24.8), ("stay", 6.0, 10.3), ("next", 0.5, 15.8), ("onward", 0.5, 13.4)],
)
def test_drones_go_where_the_fleet_file_says(after: str, x: float, metres: float) -> None:
    trips = apps.trip("A", 5.0), apps.trip("B", 6.0)
    flown = apps.flown(apps.mission("m", *trips), on=apps.fleet(after=AfterTrip(after)))
    assert flown.completed
    assert flown.drones[0].location[0] == pytest.approx(x)
    assert flown.flown["cf1"] == pytest.approx(metres, abs=0.01)


@pytest.mark.parametrize(("later", "is_taken"), [(0.4, True), (0.7, False)])
def test_one_that_flies_onward_is_offered_for_a_moment(later: float, is_taken: bool) -> None:
    """A hook takes a moment to say how a mission goes on."""
    on = apps.fleet(HOMES[0], after=AfterTrip.ONWARD)
    first = apps.flown(*missions("a", x=9.0), on=on, clock=True)
    ends = apps.moments(first, "trip.completed")["a"]
    waits = apps.mission("b", apps.trip("1", 9.0, delay=ends + later))
    flown = apps.flown(*missions("a", x=9.0), waits, on=on, clock=True)
    began = apps.moments(flown, "trip.launched")["b"]
    assert (began < ends + 0.6) is is_taken


# What policies are asked


def asked_by(answers: Any, *flown: apps.Mission) -> tuple[list[list[str]], apps.SimulationResult]:
    """Fly with a policy; return which candidates it was given each time."""
    asked: list[list[str]] = []

    def policy(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
        asked.append([drone.id for drone in candidates])
        answer: Drone | None = answers(trip, candidates, len(asked))
        return answer

    return asked, apps.flown(*flown, policy=own_policy(policy), on=THREE)


def test_a_drone_that_was_not_given_is_offered_again() -> None:
    """Not only to missions that come later."""
    asked, flown = asked_by(
        lambda trip, drones, count: drones[0] if trip.name == "A" or count > 2 else None,
        *missions("a", "b"),
    )
    assert flown.completed
    assert asked[:3] == [["cf1", "cf2", "cf3"], ["cf2", "cf3"], ["cf2", "cf3"]]


def test_candidates_come_in_the_fleets_order_in_any_order_of_coming_free() -> None:
    far = apps.mission("far", *(apps.trip(str(n), 1.0) for n in range(3)))
    near = apps.mission("near", *(apps.trip(str(n), 9.0) for n in range(6)))
    asked, flown = asked_by(lambda trip, drones, count: drones[-1], far, near)
    assert flown.completed
    assert all(ids == sorted(ids) for ids in asked)
    assert {len(ids) for ids in asked} == {1, 2, 3}


@pytest.mark.parametrize("answer", ["cf1", 7])
def test_a_policy_that_names_no_candidate_is_at_fault(answer: Any) -> None:
    _, flown = asked_by(lambda *_: answer, *missions("m"))
    assert "must return one of the candidates or None" in flown.missions[0].reason


# Of very many that wait few are looked at


def plan(count: int) -> list[apps.Mission]:
    chance = Random(3)
    spots = [(chance.uniform(1, 19), chance.uniform(1, 19)) for _ in range(2 * count)]
    return [
        apps.mission(
            f"m{n}", *(apps.trip(str(k), *spots[2 * n + k], priority=n % 3) for k in (0, 1))
        )
        for n in range(count)
    ]


FIVE = tuple((2.0 + 3 * n, 10.0, 0.0) for n in range(5))
WEAK = Category(name="scout", flight_time=200.0, charge_time=400.0)


@pytest.mark.parametrize("after", AfterTrip)
@pytest.mark.parametrize("policy", [nearest, least_used, first])
def test_many_missions_come_to_their_end_in_the_order_of_their_priorities(
    policy: Policy, after: AfterTrip
) -> None:
    on = apps.fleet(*FIVE, after=after)
    flown = apps.flown(*plan(40), policy=policy, attempts=3, categories=(WEAK,), on=on)
    assert flown.completed
    ended = apps.moments(flown, "mission.ended")
    by_priority = [sum(ended[f"m{n}"] for n in range(rank, 40, 3)) / 14 for rank in range(3)]
    assert by_priority[2] < by_priority[1] < by_priority[0]


def test_few_are_looked_at_however_many_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    """A look at all would be 150 bounds a trip."""
    asked = 0
    at_least = Request.at_least

    def counted(self: Request, drone: Drone, here: Any) -> float:
        nonlocal asked
        asked += 1
        return at_least(self, drone, here)

    monkeypatch.setattr(Request, "at_least", counted)
    assert apps.flown(*plan(150), categories=(WEAK,), on=apps.fleet(*FIVE)).completed
    assert asked < 20 * 300


@pytest.mark.parametrize("apart", [0.0, 0.5])
@pytest.mark.parametrize("after", AfterTrip)
@pytest.mark.parametrize("policy", [nearest, first, least_makespan])
def test_where_nothing_is_charged_each_mission_flies_or_says_that(
    policy: Policy, after: AfterTrip, apart: float
) -> None:
    """No level rises, in either world, and nobody waits for one that will."""
    on = replace(apps.fleet(*FIVE[:2], after=after, apart=apart), charges_at_home=False)
    flown = apps.flown(*plan(40), policy=policy, attempts=3, categories=(WEAK,), on=on)
    failed = [one for one in flown.missions if one.status is Status.FAILED]
    assert not flown.given_up and failed and any(one.completed_trips for one in flown.missions)
    assert all("nothing charges it at home" in one.reason for one in failed)
    levels: dict[object, list[Any]] = {}
    for event in flown.events:
        if "battery" in event:
            levels.setdefault(event["drone"], []).append(event["battery"])
    assert len(levels) == 2 and all(a >= b for told in levels.values() for a, b in pairwise(told))
    charged = replace(on, charges_at_home=True)
    assert apps.flown(*plan(40), policy=policy, categories=(WEAK,), on=charged).completed
