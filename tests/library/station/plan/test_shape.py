"""What a page may send: every shape but the one that plans have is refused, in words."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.plan import MissionPlan, Stale
from pluto_fleet.station.plan.shape import LONGEST_TEXT, MOST_MISSIONS, MOST_TRIPS
from tests.library.station.plan.drawing import PLANS, Json, a_plan, mission, said, trip

SCALARS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5), st.just("\ud800")
)
KEYS = st.one_of(
    st.sampled_from(["key", "name", "launched", "trips", "action", "target", "item", "delay"]),
    st.text(max_size=3),
)
ANYTHING = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=4)
)


def refused(missions: object) -> str:
    plan = a_plan()
    before = plan.data()
    with pytest.raises(BadInput) as caught:
        plan.replace(plan.revision, missions)
    assert plan.data() == before
    return str(caught.value)


def without(given: Json, key: str) -> Json:
    return {name: value for name, value in given.items() if name != key}


@pytest.mark.parametrize(
    ("missions", "sentence"),
    [
        (None, "missions this value is not a list"),
        ({}, "missions {…} is not a list"),
        ([3], "mission 1 3 is not an object"),
        ([without(mission(), "key")], "mission 1 has no key"),
        ([without(mission(), "name")], "mission 1 has no name"),
        ([without(mission(), "trips")], "mission 1 has no trips"),
        ([mission("short")], 'mission 1: key "short" is not 8 to 32 letters, digits, - and _'),
        ([mission(name=3)], "mission 1: name 3 is not a text"),
        ([mission(name="x" * (LONGEST_TEXT + 1))],
         f"mission 1: name is longer than {LONGEST_TEXT} characters"),
        ([mission(name="\ud800")], "mission 1: name holds half a character: it is no text"),
        ([mission(launched=1)], "mission 1: launched 1 is not true or false"),
        ([mission(every="1 h")],
         ('mission 1 has an unknown key "every"; it may have: key, name, launched, ended, done, opens, deadline, after, trips, '
          "safe_time, repeat, at, evaluator")),
        ([mission(safe_time=[1])], 'mission 1: "safe_time" […] is not a number or a text'),
        ([mission(safe_time=float("nan"))], 'mission 1: "safe_time" nan is not a finite number'),
        ([mission(safe_time=10**400)], 'mission 1: "safe_time" is too large a number'),
        ([mission("mission-one", without(trip(), "action"))], "mission 1, trip 1 has no action"),
        ([mission("mission-one", trip(action=None))],
         "mission 1, trip 1: action this value is not a text"),
        ([mission("mission-one", trip(target=[1]))],
         "mission 1, trip 1: target […] is not a list of two or three numbers"),
        ([mission("mission-one", trip(target=[1, "2 m"]))],
         "mission 1, trip 1: target […] is not a list of two or three numbers"),
        ([mission("mission-one", trip(target=[1, True]))],
         "mission 1, trip 1: target […] is not a list of two or three numbers"),
        ([mission("mission-one", trip(target=[1, float("inf")]))],
         "mission 1, trip 1: target inf is not a finite number"),
        ([mission("mission-one", trip(item={"name": "pills", "colour": "red"}))],
         'mission 1, trip 1: item has an unknown key "colour"; it may have: name, mass'),
        ([mission("mission-one", trip(parameters=[]))],
         "mission 1, trip 1: parameters [] is not an object"),
        ([mission("mission-one", trip(parameters={f"p{i}": 1 for i in range(65)}))],
         "a plan has at most 64 parameters for an action"),
        ([mission(), mission()], 'two missions or trips have the key "mission-one"'),
        ([mission("mission-one", trip(), trip())],
         'two missions or trips have the key "trip-one"'),
        ([mission("mission-one", trip("mission-one"))],
         'two missions or trips have the key "mission-one"'),
    ],
)  # fmt: skip
def test_another_shape_is_refused(missions: object, sentence: str) -> None:
    """With a sentence for the authors of pages, and nothing changes."""
    assert refused(missions) == sentence


def test_a_plan_has_an_end() -> None:
    """So many missions, and so many trips in all."""
    many = [mission(f"mission-{i}") for i in range(MOST_MISSIONS)]
    assert refused([*many, mission()]) == f"a plan has at most {MOST_MISSIONS} missions"
    trips = [trip(f"trip-{i:05}") for i in range(MOST_TRIPS + 1)]
    assert refused([mission("mission-one", *trips)]) == f"a plan has at most {MOST_TRIPS} trips"


def test_what_is_not_given_needs_no_key() -> None:
    """Pages may leave a field out, or say null."""
    plan, other = a_plan(), a_plan()
    plan.replace(plan.revision, [mission()])
    nothing: Json = dict.fromkeys(("name", "source", "item", "parameters", "delay"))
    full = mission("mission-one", trip("mission-one-trip", **nothing), safe_time=None)
    other.replace(other.revision, [full])
    assert plan.data() == other.data()


@pytest.mark.parametrize("revision", [None, "1", True, 1.0, [], 10**400])
def test_a_revision_is_a_whole_number(revision: object) -> None:
    """Called anything else by a page: it is told so, or that there is another one."""
    plan = a_plan()
    with pytest.raises((BadInput, Stale)):
        plan.replace(revision, [mission()])
    assert plan.data()["missions"] == []


@given(ANYTHING, ANYTHING)
@settings(max_examples=200, derandomize=True, deadline=None)
def test_anything_is_taken_or_refused(revision: Any, missions: Any) -> None:
    """No JSON raises anything else."""
    plan = a_plan()
    try_to(plan, plan.revision, missions)
    try_to(plan, revision, missions)


@given(PLANS, ANYTHING, st.data())
@settings(max_examples=300, derandomize=True, deadline=None)
def test_a_plan_with_anything_in_one_place_is_taken_or_refused(
    missions: list[Json], anything: Any, data: st.DataObject
) -> None:
    """What is taken comes back as it was given, and its problems are sentences."""
    places = [one for m in missions for one in (m, *m["trips"])]
    if places:
        place = data.draw(st.sampled_from(places))
        place[data.draw(st.sampled_from([*place, "item", "parameters"]))] = anything
    plan = a_plan()
    try_to(plan, plan.revision, missions)
    try_to(plan, plan.revision, plan.data()["missions"])
    assert all(text for *_, text in said(plan))


def try_to(plan: MissionPlan, revision: object, missions: object) -> None:
    try:
        plan.replace(revision, missions)
    except (BadInput, Stale) as error:
        assert str(error).isprintable()
