"""Evaluators: what their verdicts do, and what becomes of verdicts that cannot be followed."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Mission, Results
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.hooks.context import Verdict
from tests.runtime import apps


def judged(hook: object, *trips: apps.Trip, **more: Any) -> apps.SimulationResult:
    assert callable(hook)
    tested = apps.app(
        apps.flow(evaluator=hook, repeater=True), evaluators={"other": lambda m, r: Verdict()}
    )
    return apps.fly(tested, apps.mission("m", *(trips or (apps.trip("A", 3.0),)), **more))


def test_a_good_mission_is_completed_and_its_log_is_shown() -> None:
    outcome = judged(lambda mission, results: Verdict(log=("all is well",)))
    assert outcome.completed
    assert outcome.log == ["all is well"]


@pytest.mark.parametrize(
    ("verdict", "reason"),
    [
        (Verdict(ok=False), "<lambda> did not accept it"),
        (Verdict(fail="the field is flooded"), "the field is flooded"),
    ],
)
def test_a_rejected_mission_has_failed_with_the_reason(verdict: Verdict, reason: str) -> None:
    (mission,) = judged(lambda mission, results: verdict).missions
    assert (mission.status, mission.reason) == (Status.FAILED, reason)


def test_trips_to_redo_fly_again_as_a_further_attempt() -> None:
    def once_more(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        first = [r.trip for r in results.new if r.attempt == 1]
        return Verdict(ok=not first, redo=tuple(first))

    outcome = judged(once_more, apps.trip("A", 3.0), apps.trip("B", 4.0))
    assert outcome.completed
    assert [e["attempt"] for e in apps.events(outcome, "trip.launched")] == [1, 1, 2, 2]


def test_added_trips_fly_and_are_not_repeated_by_a_further_round() -> None:
    def add_one(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        if mission.round == 0 and len(mission.completed_trips) == 1:
            return Verdict(add=(apps.trip("extra", 5.0),))
        return Verdict()

    outcome = judged(add_one, repeat=1)
    flown = [(e["round"], e["trip"]) for e in apps.events(outcome, "trip.launched")]
    assert flown == [(0, "A"), (0, "extra"), (1, "A")]


@pytest.mark.parametrize("together", [1, 2])
def test_added_trips_of_one_name_get_names_of_their_own(together: int) -> None:
    """One after the other, or both at once."""

    def add_two(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        twins = tuple(apps.trip("A", 5.0) for _ in range(together))
        return Verdict(add=twins if len(mission.completed_trips) < 3 else ())

    (mission,) = judged(add_two).missions
    assert [trip.name for trip in mission.completed_trips] == ["A", "A 2", "A 3"]


def test_an_evaluator_sees_what_is_new_of_its_mission_and_everything_of_all() -> None:
    seen: list[tuple[str, int, int]] = []

    def look(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        seen.append((mission.name, len(results.new), len(results.all)))
        return Verdict()

    tested = apps.app(apps.flow(evaluator=look, repeater=True))
    apps.fly(
        tested,
        apps.mission("near", apps.trip("A", 2.0), repeat=1),
        apps.mission("far", apps.trip("A", 9.0)),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0)),
    )
    assert seen == [("near", 1, 1), ("near", 1, 2), ("far", 1, 3)]


def test_a_mission_may_choose_another_of_the_apps_evaluators() -> None:
    outcome = judged(lambda mission, results: Verdict(fail="not asked"), evaluator="other")
    assert outcome.completed


@pytest.mark.parametrize(
    ("returned", "says"),
    [
        (None, "must return a Verdict, not NoneType"),
        (Verdict(redo=(apps.trip("B", 1.0),)), "redo a trip that mission m has not completed"),
        (Verdict(add=(apps.trip("B", 99.0),)), "cannot be flown"),
        (Verdict(add=(apps.trip("B", 9.0, action="dance"),)), "there is no action 'dance'"),
        (Verdict(add=(apps.pick("B", 9.0),)), "pick and release cannot be added"),
        (
            Verdict(add=(apps.trip("B", 9.0, parameters={"x": 1}),)),
            "take_photo has no parameter 'x'",
        ),
    ],
)
def test_a_verdict_that_cannot_be_followed_fails_the_mission(returned: object, says: str) -> None:
    (mission,) = judged(lambda mission, results: returned).missions
    assert mission.status is Status.FAILED
    assert says in mission.reason


def test_an_evaluator_that_raises_fails_its_mission_and_no_other() -> None:
    def broken(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        if mission.name == "bad":
            raise KeyError("no such photo")
        return Verdict()

    outcome = apps.fly(
        apps.app(apps.flow(evaluator=broken)),
        apps.mission("bad", apps.trip("A", 2.0)),
        apps.mission("good", apps.trip("A", 9.0)),
    )
    bad, good = outcome.missions
    assert bad.reason == "hook broken raised KeyError: 'no such photo'"
    assert "Traceback" in outcome.log[0]
    assert good.status is Status.COMPLETED
