"""Each person takes back their own changes of a plan, and none of another's."""

from __future__ import annotations

import json
from copy import deepcopy
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.history import MOST, Step
from pluto_fleet.station.plan.merge import Collision, first_shared, merged, touched
from pluto_fleet.station.plan.plan import MissionPlan, Stale
from tests.station.plan.drawing import Json, a_plan, mission, trip

A, B = "browser-a", "browser-b"


def missions(plan: MissionPlan) -> list[Json]:
    found: Any = deepcopy(plan.data()["missions"])
    return found


def draw(plan: MissionPlan, by: str, *given: Json) -> None:
    plan.replace(plan.revision, list(given), by)


def undo(plan: MissionPlan, by: str) -> None:
    plan.step_back(plan.revision, by, Step.UNDO)


def redo(plan: MissionPlan, by: str) -> None:
    plan.step_back(plan.revision, by, Step.REDO)


def names(plan: MissionPlan) -> list[str]:
    return [str(one["name"]) for one in missions(plan)]


def test_what_one_person_takes_back_another_has_not_drawn() -> None:
    """Nor is it lost when it comes back."""
    plan = a_plan()
    draw(plan, A, mission("mission-one"))
    draw(plan, B, *missions(plan), mission("mission-two"))
    undo(plan, A)
    assert names(plan) == ["mission-two"]
    redo(plan, A)
    assert names(plan) == ["mission-one", "mission-two"]
    undo(plan, B)
    assert names(plan) == ["mission-one"]


def test_two_draw_on_one_mission() -> None:
    """Its name, and a trip of it, are taken back apart."""
    plan = a_plan()
    draw(plan, A, mission("mission-one"))
    [one] = missions(plan)
    draw(plan, A, {**one, "name": "North"})
    [one] = missions(plan)
    draw(plan, B, {**one, "trips": [*one["trips"], trip("trip-two-2")]})
    undo(plan, A)
    [one] = missions(plan)
    assert (one["name"], len(one["trips"])) == ("mission-one", 2)
    with pytest.raises(BadInput, match='mission "mission-one" was changed by another person since'):
        undo(plan, A)
    assert missions(plan) == [one]


def test_the_same_written_again_by_another_is_theirs() -> None:
    """Though it looks as it did."""
    plan = a_plan()
    draw(plan, B, mission(name="first"))
    draw(plan, A, mission(name="second"))
    draw(plan, B, mission(name="third"))
    draw(plan, B, mission(name="second"))
    with pytest.raises(BadInput, match="by another person"):
        undo(plan, A)
    assert names(plan) == ["second"]


def test_moves_are_taken_back_beside_what_others_add() -> None:
    """A new mission keeps its place behind its neighbour; two orders do not become a third."""
    plan = a_plan()
    one, two, six = (mission(f"mission-{n}") for n in ("one", "two", "six"))
    draw(plan, B, one, two)
    draw(plan, A, two, one)
    draw(plan, B, two, six, one)
    undo(plan, A)
    assert names(plan) == ["mission-one", "mission-two", "mission-six"]
    redo(plan, A)
    draw(plan, B, *missions(plan)[::-1])
    with pytest.raises(BadInput, match="the order of the missions was changed by another person"):
        undo(plan, A)


def test_a_new_change_ends_what_could_be_done_again() -> None:
    """Of its own author alone."""
    plan = a_plan()
    draw(plan, A, mission("mission-one"))
    undo(plan, A)
    draw(plan, B, mission("mission-two"))
    assert (plan.history.can(A, Step.REDO), plan.history.can(B, Step.UNDO)) == (True, True)
    draw(plan, A, *missions(plan), mission("mission-six"))
    with pytest.raises(BadInput, match="nothing of yours to redo"):
        redo(plan, A)


@pytest.mark.parametrize("by", ["", A])
def test_who_has_drawn_nothing_takes_nothing_back(by: str) -> None:
    """Nor does one that does not say who it is."""
    plan = a_plan()
    draw(plan, "", mission())
    with pytest.raises(BadInput, match="nothing of yours to undo"):
        undo(plan, by)


def test_what_flies_stays() -> None:
    """It may be taken back when it has flown."""
    plan = a_plan()
    draw(plan, A, mission())
    draw(plan, A, mission(name="other"))
    plan.launched(["mission-one"])
    with pytest.raises(BadInput, match='mission "other" flies'):
        undo(plan, A)
    plan.settle({"other": "COMPLETED"})
    undo(plan, A)
    [one] = missions(plan)
    assert (one["name"], one["ended"]) == ("mission-one", "COMPLETED")


def test_what_was_changed_since_it_completed_counts_as_new() -> None:
    """Also if that was by taking a change back."""
    plan = a_plan()
    draw(plan, A, mission())
    draw(plan, A, mission("mission-one", trip("trip-two-2", target=[5, 5])))
    plan.launched(["mission-one"])
    plan.settle({"mission-one": "COMPLETED"})
    undo(plan, A)
    assert missions(plan)[0]["ended"] is None


def test_nothing_is_taken_back_on_an_old_plan() -> None:
    plan = a_plan()
    draw(plan, A, mission())
    with pytest.raises(Stale):
        plan.step_back(plan.revision - 1, A, Step.UNDO)


def test_only_the_last_changes_are_kept() -> None:
    """One after another, down to the oldest of them."""
    plan = a_plan()
    for count in range(MOST + 5):
        draw(plan, A, mission(name=f"{count}"))
    assert len(plan.history.changes) == MOST
    while plan.history.can(A, Step.UNDO):
        undo(plan, A)
    # an undo is a change, too: half of them are left behind by the other half
    assert int(names(plan)[0]) < MOST


def test_different_things_of_the_same_are_a_collision() -> None:
    """In a field, and of a mission that one has deleted; equal ones are none."""
    base = [mission()]
    for mine, theirs in (
        ([mission(name="x")], [mission(name="y")]),
        ([], [mission(name="y")]),
    ):
        with pytest.raises(Collision):
            merged(base, mine, theirs)
        assert first_shared(touched(base, mine), touched(base, theirs)) is not None
    assert merged(base, [mission(name="x")], [mission(name="x")]) == [mission(name="x")]


VALUES = st.sampled_from(["x", "y", "z"])


class Drawing(RuleBasedStateMachine):
    """Two people draw, undo and redo: what one wrote last stays until that person takes it back."""

    def __init__(self) -> None:
        super().__init__()
        self.plan = a_plan()
        self.count = 0
        self.wrote: dict[tuple[str, str, str], tuple[str, object]] = {}
        """What each field of each trip and mission was given last, and by whom."""

    def edit(self, by: str, new: list[Json]) -> None:
        before = fields(missions(self.plan))
        draw(self.plan, by, *new)
        self.note(by, before)

    def note(self, by: str, before: dict[tuple[str, str, str], object]) -> None:
        after = fields(missions(self.plan))
        for part in {**before, **after}:
            if before.get(part) != after.get(part):
                other, value = self.wrote.get(part, (by, None))
                if self.takes_back and value is not None:
                    assert other == by, (part, value)
                self.wrote[part] = by, after.get(part)

    takes_back = False

    @rule(by=st.sampled_from([A, B]), at=st.integers(0, 3), name=VALUES)
    def add(self, by: str, at: int, name: str) -> None:
        self.count += 1
        new = missions(self.plan)
        key = f"mission-{self.count:04}"
        new.insert(at, mission(key, trip(f"{key}-t"), name=name))
        self.edit(by, new)

    @precondition(lambda self: not self.plan.is_empty)
    @rule(by=st.sampled_from([A, B]), at=st.integers(0, 9), name=VALUES)
    def rename(self, by: str, at: int, name: str) -> None:
        new = missions(self.plan)
        new[at % len(new)]["name"] = name
        self.edit(by, new)

    @precondition(lambda self: not self.plan.is_empty)
    @rule(by=st.sampled_from([A, B]), at=st.integers(0, 9), x=st.integers(1, 3))
    def move_a_trip(self, by: str, at: int, x: int) -> None:
        new = missions(self.plan)
        new[at % len(new)]["trips"][0]["target"] = [x, 1]
        self.edit(by, new)

    @precondition(lambda self: not self.plan.is_empty)
    @rule(by=st.sampled_from([A, B]), at=st.integers(0, 9))
    def delete(self, by: str, at: int) -> None:
        new = missions(self.plan)
        new.pop(at % len(new))
        self.edit(by, new)

    @rule(by=st.sampled_from([A, B]))
    def reverse(self, by: str) -> None:
        self.edit(by, missions(self.plan)[::-1])

    @rule(by=st.sampled_from([A, B]), step=st.sampled_from([Step.UNDO, Step.UNDO, Step.REDO]))
    def take_back(self, by: str, step: Step) -> None:
        """What another wrote last is not written over."""
        before, whole = fields(missions(self.plan)), missions(self.plan)
        try:
            self.plan.step_back(self.plan.revision, by, step)
        except BadInput:
            assert missions(self.plan) == whole
            return
        self.takes_back = True
        self.note(by, before)
        self.takes_back = False

    @invariant()
    def sound(self) -> None:
        """The plan is one that pages may send."""
        self.plan.replace(self.plan.revision, missions(self.plan))


def fields(given: list[Json]) -> dict[tuple[str, str, str], object]:
    """Return the fields that people write: names of missions, places of trips."""
    found: dict[tuple[str, str, str], object] = {}
    for one in given:
        found[one["key"], "", "name"] = one["name"]
        for each in one["trips"]:
            found[one["key"], each["key"], "target"] = each["target"]
    return found


TestDrawing = Drawing.TestCase
TestDrawing.settings = settings(
    max_examples=60, stateful_step_count=25, derandomize=True, deadline=None
)


class Alone(Drawing):
    """One person takes all back, and does all again: byte for byte."""

    def __init__(self) -> None:
        super().__init__()
        self.texts = [json.dumps(missions(self.plan))]

    def edit(self, by: str, new: list[Json]) -> None:
        draw(self.plan, A, *new)
        text = json.dumps(missions(self.plan))
        if text != self.texts[-1]:
            self.texts.append(text)

    @rule(by=st.just(A), step=st.just(Step.UNDO))
    def take_back(self, by: str, step: Step) -> None:
        for text in self.texts[-2::-1]:
            undo(self.plan, A)
            assert json.dumps(missions(self.plan)) == text
        assert not self.plan.history.can(A, step)
        for text in self.texts[1:]:
            redo(self.plan, A)
            assert json.dumps(missions(self.plan)) == text


TestAlone = Alone.TestCase
TestAlone.settings = settings(
    max_examples=20, stateful_step_count=12, derandomize=True, deadline=None
)
