"""A policy hook that is asked for all trips that wait: `(waiting, drones, now)`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial, wraps
from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Category, Drone
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.own_policy import (
    Again,
    Assignment,
    Waiting,
    chooses_for_all,
    own_policy,
)
from tests.kit import apps

HOMES = ((0.5, 0.5, 0.0), (9.5, 0.5, 0.0), (18.5, 0.5, 0.0))
Waits = Sequence[Waiting[Any, Any]]


def missions(*places: float, **more: int) -> list[apps.Mission]:
    return [
        apps.mission(f"m{n}", apps.trip("A", x, priority=more.get(f"m{n}", 0)))
        for n, x in enumerate(places)
    ]


def fly(hook: Callable[..., Any], *flown: apps.Mission, homes: int = 3) -> apps.SimulationResult:
    app = apps.app(apps.flow(policy=own_policy(hook)))
    return apps.fly(app, *flown, on=apps.fleet(*HOMES[:homes]))


def given(outcome: apps.SimulationResult) -> list[tuple[str, str, str]]:
    found = apps.events(outcome, "trip.allocated")
    return [(str(e["mission"]), str(e["drone"]), str(e["why"])) for e in found]


def test_it_sees_all_that_wait_and_what_is_known_of_them() -> None:
    asked: list[tuple[Waits, Sequence[Drone], float]] = []

    def farthest(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        asked.append((waiting, drones, now))
        one = max(waiting, key=lambda each: each.trip.target[0])
        return {one: drones[0]}

    outcome = fly(farthest, *missions(3.0, 9.0, 6.0), homes=1)
    assert outcome.completed
    assert [mission for mission, *_ in given(outcome)] == ["m1", "m2", "m0"]
    assert {why for *_, why in given(outcome)} == {"chosen by farthest"}
    waiting, drones, now = asked[0]
    assert [(one.mission.name, one.trip.name, one.since, one.priority) for one in waiting] == [
        ("m0", "A", 0.0, 0), ("m1", "A", 0.0, 0), ("m2", "A", 0.0, 0),
    ]  # fmt: skip
    assert now == 0.0
    assert all(one.drones == tuple(drones) and one.deadline is None for one in waiting)
    assert asked[1][2] > 0.0
    assert len(asked[1][0]) == 2


def test_pairs_may_come_in_any_iterable() -> None:
    def pairs(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        return zip(waiting, reversed(drones), strict=False)

    outcome = fly(pairs, *missions(3.0, 9.0))
    assert [(mission, drone) for mission, drone, _ in given(outcome)] == [
        ("m0", "cf3"), ("m1", "cf2"),
    ]  # fmt: skip


def test_it_is_asked_for_each_priority_apart_the_highest_first() -> None:
    asked: list[list[int]] = []

    def first(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        asked.append([one.priority for one in waiting])
        return [(waiting[0], drones[0])]

    assert fly(first, *missions(3.0, 9.0, 6.0, m1=2, m2=1), homes=2).completed
    assert asked[:2] == [[2], [1]]


def test_an_empty_assignment_waits_for_the_next_change() -> None:
    asked: list[float] = []

    def one_by_one(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        asked.append(now)
        return [(waiting[0], drones[0])] if len(drones) == 3 else ()

    outcome = fly(one_by_one, *missions(3.0, 9.0))
    assert outcome.completed
    first, second = apps.times(outcome, "trip.allocated")
    assert second > first == 0.0
    assert asked == sorted(asked)


def test_it_can_ask_to_be_asked_again_at_a_time() -> None:
    asked: list[float] = []

    def later(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        asked.append(now)
        return Again(after=0.5) if len(asked) < 3 else {waiting[0]: drones[0]}

    assert fly(later, *missions(0.6)).completed
    assert asked == [0.0, 0.5, 1.0]


def test_it_can_give_some_now_and_be_asked_again_for_the_rest() -> None:
    def slowly(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        return Again(after=5.0, pairs=[(waiting[0], drones[0])])

    outcome = fly(slowly, *missions(3.0, 9.0, 6.0))
    assert apps.times(outcome, "trip.allocated") == [0.0, 5.0, 10.0]


def test_one_that_asks_for_ever_and_gives_nothing_is_at_fault(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("pluto_fleet.shared.fleet.own_policy.MOST_IN_VAIN", 20)
    outcome = fly(lambda waiting, drones, now: Again(after=1.0), *missions(3.0))
    (mission,) = outcome.missions
    assert "has asked 20 times to be asked again, and given no drone" in mission.reason


def other(waiting: Waits) -> Waiting[Any, Any]:
    return waiting[0]._replace(since=-1.0)


def endless(waiting: Waits) -> Iterator[Any]:
    while True:
        yield waiting[0], waiting[0].drones[0]


WRONG: dict[str, tuple[Callable[[Waits, Sequence[Drone]], Any], str, str]] = {
    "nothing": (lambda w, d: None, "m0", "must return pairs of a waiting trip and a drone, not None"),
    "a number": (lambda w, d: 7, "m0", "a waiting trip and a drone, not 7"),
    "a text": (lambda w, d: "cf1", "m0", "a waiting trip and a drone, not str"),
    "a drone": (lambda w, d: d[0], "m0", "a waiting trip and a drone, not drone cf1"),
    "no pairs": (lambda w, d: [d[0]], "m0", "a waiting trip and a drone, not drone cf1"),
    "three": (lambda w, d: [(w[0], d[0], d[1])], "m0", "a waiting trip and a drone, not tuple"),
    "a trip": (lambda w, d: {w[1].trip: d[0]}, "m0", "gives a drone to Trip, which is none of those"),
    "an unknown one": (lambda w, d: [(other(w), d[0])], "m0",
                       "gives a drone to trip A of mission \"m0\", which is none of those that wait"),
    "no drone": (lambda w, d: {w[1]: "cf1"}, "m1",
                 "gives trip A of mission \"m1\" str, which is none of the free drones"),
    "none": (lambda w, d: {w[1]: None}, "m1", "gives trip A of mission \"m1\" None, which is none"),
    "a drone twice": (lambda w, d: {w[0]: d[0], w[1]: d[0]}, "m1",
                      "gives drone cf1 twice, to trip A of mission \"m0\" and trip A of mission \"m1\""),
    "a trip twice": (lambda w, d: [(w[1], d[0]), (w[1], d[1])], "m1",
                     "gives trip A of mission \"m1\" two drones, cf1 and cf2"),
    "endlessly": (lambda w, d: endless(w), "m0", "two drones, cf1 and cf1"),
    "too soon": (lambda w, d: Again(after=0.01), "m0", "after 0.01: that must be a number of seconds"),
    "no time": (lambda w, d: Again(after="5 s"), "m0", "after str: that must be"),  # type: ignore[arg-type]
    "an error": (lambda w, d: w[7], "m0", "raised IndexError: tuple index out of range"),
}  # fmt: skip


@pytest.mark.parametrize("what", list(WRONG))
def test_what_is_wrong_fails_one_mission_and_is_asked_anew_for_the_others(what: str) -> None:
    """The one that the wrong pair names; the one that has waited longest, where it names none."""
    wrong, guilty, said = WRONG[what]
    done: list[str] = []

    def policy(waiting: Waits, drones: Sequence[Drone], now: float) -> Any:
        if not done:
            done.append(what)
            return wrong(waiting, drones)
        return dict(zip(waiting, drones, strict=False))

    outcome = fly(policy, *missions(3.0, 9.0))
    ends = {mission.name: (mission.status, mission.reason) for mission in outcome.missions}
    status, reason = ends.pop(guilty)
    assert status is Status.FAILED
    assert reason.startswith("policy policy ")
    assert said in reason
    assert [status for status, _ in ends.values()] == [Status.COMPLETED]
    assert apps.times(outcome, "trip.allocated") == [0.0]


def test_a_drone_that_cannot_fly_it_is_a_fault() -> None:
    """Here it has not enough in its battery."""

    def any_drone(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        far = max(waiting, key=lambda one: one.trip.target[0])
        return {far: drones[0]}

    tired = Category(name="scout", flight_time=70.0)
    app = apps.app(apps.flow(policy=own_policy(any_drone)), categories=(tired,))
    flown = missions(1.0, 1.0, 14.0)
    outcome = apps.fly(app, *flown, on=apps.fleet((0.5, 0.5, 0.0), (13.0, 0.5, 0.0)))
    reasons = [mission.reason for mission in outcome.missions if mission.reason]
    assert reasons == [
        'policy any_drone gives trip A of mission "m2" drone cf1, which cannot fly it now'
    ]


def test_the_shape_is_told_by_three_parameters_without_a_default() -> None:
    def decorated(hook: Any) -> Any:
        @wraps(hook)
        def around(*given: object) -> object:
            return hook(*given)

        return around

    def for_all(waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
        return ()

    class Callable_:  # noqa: N801
        def __call__(self, waiting: Waits, drones: Sequence[Drone], now: float) -> Assignment:
            return ()

    shapes = (for_all, decorated(for_all), Callable_(), partial(for_all))
    assert all(chooses_for_all(shape) for shape in shapes)
    others = (lambda trip, candidates: None, lambda t, c, seed=1: None, max, lambda *given: None)
    assert not any(chooses_for_all(other) for other in others)
