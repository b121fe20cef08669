"""Several people draw one plan, and parts of it fly meanwhile."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.plan import MissionPlan, Stale
from pluto_fleet.station.plan.problems import PlanProblem
from tests.library.station.plan.drawing import a_plan, drawn, mission, trip

KEYS = ["mission-one", "mission-two"]


def keys_of(plan: MissionPlan) -> list[str]:
    missions: Any = plan.data()["missions"]
    return [one["key"] for one in missions]


def test_what_is_there_already_may_be_said_again() -> None:
    """An answer may have been lost on its way: nothing is done twice, and no page is refused."""
    plan = a_plan()
    old = plan.revision
    plan.replace(old, [mission()])
    new = plan.revision
    plan.replace(old, [mission()])
    assert plan.revision == new
    plan.replace(new, [])
    assert plan.revision == new + 1


def test_what_flies_stays_as_it_is() -> None:
    """No matter what a page sends of it; left out, it comes first."""
    plan = drawn(*map(mission, KEYS))
    before: Any = plan.data()["missions"]
    plan.launched(["mission-two"])
    other = mission("mission-two", trip(), name="other", launched=False)
    plan.replace(plan.revision, [other, mission("mission-one")])
    assert keys_of(plan) == ["mission-two", "mission-one"]
    plan.replace(plan.revision, [mission("mission-six")])
    missions: Any = plan.data()["missions"]
    assert [one["key"] for one in missions] == ["mission-two", "mission-six"]
    assert missions[0] == {**before[1], "launched": True}


def test_who_has_drawn_a_mission_otherwise_that_was_launched_meanwhile_is_told() -> None:
    """Though the plan stays as it is; who has changed nothing of it is refused nothing."""
    plan = drawn(*map(mission, KEYS))
    old = plan.revision
    plan.launched(KEYS)
    new = plan.revision
    with pytest.raises(Stale):
        plan.replace(old, [mission(KEYS[0], name="other"), mission(KEYS[1])])
    plan.replace(old, list(map(mission, KEYS)))
    assert plan.revision == new


def test_a_key_of_what_flies_is_taken() -> None:
    """A trip of a mission that was left out counts, too."""
    plan = drawn(mission("mission-one"))
    plan.launched(["mission-one"])
    with pytest.raises(BadInput, match="two missions or trips have the key"):
        plan.replace(plan.revision, [mission("mission-two", trip("mission-one-trip"))])


def test_only_what_has_not_been_launched_can_be() -> None:
    """Until nothing flies any more: then all can be, and changed as well."""
    plan = drawn(*map(mission, KEYS))
    plan.launched(["mission-one"])
    missions, keys = plan.launchable()
    assert [one.name for one in missions] == keys == ["mission-two"]
    plan.launched(keys)
    assert plan.launchable() == ([], [])
    plan.unlock()
    assert plan.launchable()[1] == KEYS


def test_a_launched_mission_and_a_new_one_may_not_share_a_name() -> None:
    """Though only the new one would be launched."""
    plan = drawn(mission("mission-one"))
    plan.launched(["mission-one"])
    plan.replace(plan.revision, [mission("mission-two", name="mission-one")])
    with pytest.raises(BadInput, match="names must differ"):
        plan.launchable()


def test_what_is_wrong_with_the_whole_plan_holds_up_every_start(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What is wrong with another mission does not, nor what is not chosen."""
    plan = drawn(*map(mission, KEYS), mission("mission-six", trip("trip-six", target=None)))
    assert plan.launchable(KEYS)[1] == KEYS
    alone = "The plan is no plan"
    whole = PlanProblem(mission=None, trip=None, field=None, text=alone, alone=alone)
    monkeypatch.setattr("pluto_fleet.station.plan.plan.read", lambda *_: ([], [whole]))
    plan.replace(plan.revision, [*map(mission, KEYS)])
    with pytest.raises(BadInput, match="The plan is no plan"):
        plan.launchable(KEYS[:1])


def test_a_mission_comes_after_one_that_is_started_with_it_or_flies_or_was_completed() -> None:
    plan = drawn(mission(KEYS[0]), mission(KEYS[1], after=[KEYS[0]]))

    def after(*chosen: str) -> object:
        missions, _ = plan.launchable(chosen or None)
        return missions[-1].promises.get("after")

    assert after() == [KEYS[0]]
    with pytest.raises(BadInput, match='comes after "mission-one", which is not started'):
        after(KEYS[1])
    plan.launched(KEYS[:1])
    assert after(KEYS[1]) == [KEYS[0]]
    plan.settle({KEYS[0]: "COMPLETED"})
    assert after(KEYS[1]) is None


def test_a_journal_that_was_found_says_what_flies() -> None:
    """Against what the plan said: the station may have ended between the one and the other."""
    plan = drawn(*map(mission, KEYS))
    plan.launched(["mission-one"])
    plan.adopt(["mission-two", "gone"])
    assert plan.launchable()[1] == ["mission-one"]
