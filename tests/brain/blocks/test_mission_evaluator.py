"""MissionEvaluator: what verdicts do, and what becomes of verdicts that cannot be followed."""

from __future__ import annotations

from collections import UserList, deque
from typing import Any

import numpy as np
import pytest

from pluto_fleet.shared.domain.model import Category, Mission, Results
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Verdict
from tests.kit import apps
from tests.library.files import an_app


def judged(hook: object, *trips: apps.Trip, **more: Any) -> apps.SimulationResult:
    assert callable(hook)
    tested = apps.app(
        apps.flow(evaluator=hook, repeater=True), evaluators={"other": lambda m, r: Verdict()}
    )
    return apps.fly(tested, apps.mission("m", *(trips or (apps.trip("A", 3.0),)), **more))


@pytest.mark.parametrize("made", [list, tuple, deque, UserList])
def test_a_verdict_takes_lists_and_other_sequences(made: Any) -> None:
    """As its types say: for trips to fly again, for new ones and for lines."""

    def again(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        if mission.attempts > 1:
            return Verdict(log=made(["done"]))
        new = apps.Trip(name="B", action="measure", target=(2.0, 2.0, 1.2))
        return Verdict(redo=made(mission.completed_trips), add=made([new]), log=made(["once more"]))

    outcome = judged(again)
    assert outcome.completed
    assert outcome.log == ["once more", "done"]
    assert [trip.name for trip in outcome.missions[0].completed_trips] == ["A", "B"]


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
        on=apps.TWO,
    )
    assert seen == [("near", 1, 1), ("near", 1, 2), ("far", 1, 3)]


def test_a_mission_may_choose_another_of_the_apps_evaluators() -> None:
    outcome = judged(lambda mission, results: Verdict(fail="not asked"), evaluator="other")
    assert outcome.completed


NOTHING: Any = None
ODD: Any = apps.trip("B", 2.0)
NUMBERS: Any = ([1],)
LINES: Any = "all is well"


@pytest.mark.parametrize(
    ("returned", "says"),
    [
        (None, "must return a Verdict, not NoneType"),
        (Verdict(add=ODD), "must give `add` as a list or a tuple, not as Trip"),
        (Verdict(redo=NOTHING), "must give `redo` as a list or a tuple, not as NoneType"),
        (Verdict(log=LINES), "must give `log` as a list or a tuple, not as str"),
        (Verdict(add=NUMBERS), "it must be a Trip of this app, not list"),
        (Verdict(fail=NUMBERS), "([1],)"),
        (Verdict(fail=" "), "did not accept it"),
        (Verdict(ok=False), "<lambda> did not accept it"),
        (Verdict(ok=np.False_), "<lambda> did not accept it"),  # type: ignore[arg-type]
        (Verdict(ok=LINES), "must give `ok` as True or False, not 'all is well'"),
        (Verdict(fail="the field is flooded"), "the field is flooded"),
        (Verdict(add=(apps.trip("B", 2.0, parameters=NOTHING),)), "parameters must be a dict"),
        (Verdict(redo=(apps.trip("B", 1.0),)), "redo a trip that mission m has not completed"),
        (Verdict(add=(apps.trip("B", 99.0),)), "cannot be flown"),
        (Verdict(add=(apps.trip("B", 9.0, action="dance"),)), "there is no action 'dance'"),
        (Verdict(add=(apps.pick("B", 9.0),)), "pick and release cannot be added"),
        (
            Verdict(add=(apps.trip("B", 9.0, parameters={"x": 1}),)),
            'trip B: take_photo: unknown key "x"; there may be: none',
        ),
    ],
)
def test_a_verdict_that_cannot_be_followed_fails_the_mission(returned: object, says: str) -> None:
    (mission,) = judged(lambda mission, results: returned).missions
    assert mission.status is Status.FAILED
    assert says in mission.reason


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"dose": "3 m"}, 'pollinate: dose "3 m" is a length, not a mass: it takes mg, g, kg'),
        ({"dose": float("inf")}, "pollinate: dose inf is not a mass (mg, g, kg) of"),
        ({"dose": 1, "strokes": 2.5}, "pollinate: strokes 2.5 is not a whole number"),
        ({}, "pollinate: has no dose"),
        # such as no missions file can have
        ({"dose": 1, 3: 1}, 'pollinate: unknown key "3"; there may be: dose, '),
        ({"dose": np.True_}, "pollinate: dose true is not a mass (mg, g, kg) of"),
        ({"dose": np.float32("inf")}, "pollinate: dose inf is not a mass (mg, g, kg) of"),
        ({"dose": [1]}, "its parameter 'dose' must be a number or a text, not [1]"),
    ],
)
def test_a_trips_parameters_are_checked_as_those_of_a_missions_file(given: Any, says: str) -> None:
    (mission,) = judged_with_parameters(given).missions
    adds = "evaluator adds adds a trip that cannot be flown: trip bloom: "
    assert mission.status is Status.FAILED
    assert mission.reason.startswith(adds + says)


def test_a_parameter_with_a_unit_is_read_as_in_a_missions_file() -> None:
    """What is a number already stays as it was given."""
    outcome = judged_with_parameters(
        {"strokes": np.int8(3), "note": np.str_("3 m"), "dose": "50 mg", "force": 2}
    )
    (mission,) = outcome.missions
    assert mission.status is Status.COMPLETED
    flown = {**mission.completed_trips[1].parameters}
    assert {name: flown[name] for name in ("strokes", "note", "dose", "force")} == {
        "strokes": 3,
        "note": "3 m",
        "dose": 5e-05,
        "force": 2,
    }
    assert [type(flown[one]) for one in ("strokes", "note", "force")] == [int, str, int]


def judged_with_parameters(given: Any) -> apps.SimulationResult:
    """Fly a mission to which its evaluator adds a trip with these parameters."""

    def adds(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        bloom = apps.trip("bloom", 4.0, action="pollinate", parameters=given)
        return Verdict(add=() if len(mission.completed_trips) > 1 else (bloom,))

    declared = an_app.APP.actions["pollinate"].parameters
    pollinate = OwnAction(name="pollinate", parameters=declared, hook=lambda *_, **__: None)
    return apps.fly(
        apps.app(apps.flow(evaluator=adds), actions=[pollinate]),
        apps.mission("m", apps.trip("A", 3.0)),
    )


def test_an_evaluator_does_not_change_the_trips_itself() -> None:
    def adds(mission: Any, results: object) -> Verdict:
        mission.trips.append(apps.trip("B", 2.0))
        return Verdict()

    assert (
        "an evaluator has trips added or flown again by its Verdict"
        in judged(adds).missions[0].reason
    )


def test_an_added_place_without_a_height_gets_the_maps() -> None:
    place: Any = (2, 3)

    def adds(mission: Mission[apps.Trip], results: object) -> Verdict:
        more = apps.Trip(name="B", action="take_photo", target=place)
        return Verdict(add=() if len(mission.completed_trips) > 1 else (more,))

    assert judged(adds).missions[0].completed_trips[1].target == (2, 3, 1.2)


@pytest.mark.parametrize("which", ["add", "redo"])
def test_a_trip_that_is_named_twice_flies_once(which: str) -> None:
    new = apps.trip("new", 4.0)

    def twice(mission: Mission[apps.Trip], results: object) -> Verdict:
        trips = [new] * 2 if which == "add" else mission.completed_trips * 2
        verdict: dict[str, Any] = {which: trips if mission.attempts == 1 else ()}
        return Verdict(**verdict)

    assert judged(twice).count("trip.launched") == 2


def test_a_trip_that_has_flown_cannot_be_added() -> None:
    """Neither to its own mission, where it is redone, nor to another."""
    extra = apps.trip("extra", 5.0)

    def adds(mission: Mission[apps.Trip], results: object) -> Verdict:
        again = mission.name == "first" and mission.attempts == 1
        return Verdict(add=(extra,) if again or mission.name == "second" else ())

    def itself(mission: Mission[apps.Trip], results: object) -> Verdict:
        return Verdict(add=mission.completed_trips)

    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in ("first", "second")]
    first, second = apps.flown(*missions, evaluator=adds).missions
    assert first.status is Status.COMPLETED
    assert "extra has been used already: make a new Trip each time" in second.reason
    assert "is the mission's already: ask to redo it" in judged(itself).missions[0].reason


def test_a_trip_that_no_drone_of_the_fleet_can_fly_is_told_with_what_each_lacks() -> None:
    kinds = Category(name="scout", actions=frozenset({"take_photo"})), Category(name="heavy")

    def adds(mission: Mission[apps.Trip], results: object) -> Verdict:
        return Verdict(add=(apps.trip("B", 3.0, action="measure"),) * (mission.attempts == 1))

    outcomes = [
        apps.flown(
            apps.mission("m", apps.trip("A", 3.0)),
            evaluator=adds,
            categories=kinds,
            on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), categories=names),
        )
        for names in (("scout",), ("scout", "heavy"))
    ]
    assert outcomes[0].missions[0].reason.endswith("cannot be flown: scout cannot measure")
    assert outcomes[1].completed
