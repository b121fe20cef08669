"""Of what failed only the trips that were not done are flown again, and picks only with their releases."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.plan import MissionPlan
from tests.library.station.plan.drawing import Json, a_plan, drawn, handling, mission, trip


def long(key: str) -> Json:
    """Return a mission of a photo, two ways with an item, and a measurement."""
    one, two = handling(f"{key}-a"), handling(f"{key}-b")
    return mission(key, trip(f"{key}-photo"), *one, *two, trip(f"{key}-photo-2", target=[6, 6]))


def failed(plan: MissionPlan, **done: list[str]) -> MissionPlan:
    """Let missions of a plan fail that have done some of their trips."""
    plan.launched([name.replace("_", "-") for name in done])
    names = {name.replace("_", "-"): trips for name, trips in done.items()}
    plan.settle(dict.fromkeys(names, "FAILED"), names)
    return plan


def missing(plan: MissionPlan, chosen: list[str] | None = None) -> dict[str, list[str]]:
    missions, _ = plan.launchable(chosen, only_failed=True)
    return {one.name: [each.name for each in one.trips] for one in missions}


@pytest.mark.parametrize(
    ("done", "again"),
    [
        ([], ["1", "2", "3", "4", "5", "6"]),
        (["1"], ["2", "3", "4", "5", "6"]),
        (["1", "2"], ["2", "3", "4", "5", "6"]),
        (["1", "2", "3"], ["4", "5", "6"]),
        (["1", "2", "3", "4"], ["4", "5", "6"]),
        (["1", "3", "5"], ["6"]),
        (["2", "3", "6"], ["1", "4", "5"]),
    ],
)
def test_what_was_picked_and_not_released_is_picked_again(
    done: list[str], again: list[str]
) -> None:
    assert missing(failed(drawn(long("mission-one")), mission_one=done)) == {"mission-one": again}


def test_what_cannot_be_flown_again_alone_is_refused_in_words(tmp_path: Path) -> None:
    keys = ("mission-one", "mission-two", "mission-six")
    plan = a_plan(tmp_path / "plan.json")
    plan.replace(plan.revision, [long(key) for key in keys])
    with pytest.raises(BadInput, match="no mission has failed of which a trip is missing"):
        missing(plan)
    with pytest.raises(BadInput, match='"mission-two" has not failed, or was changed since'):
        missing(plan, ["mission-two"])
    failed(plan, mission_one=["1"], mission_six=[str(number) for number in range(1, 7)])
    assert [*missing(plan)] == ["mission-one"]
    with pytest.raises(BadInput, match='"mission-six" failed, and all its trips were done'):
        missing(plan, ["mission-six"])
    assert missing(a_plan(tmp_path / "plan.json")) == missing(plan)  # it outlives the station
    shapes: Any = plan.data()["missions"]
    plan.replace(plan.revision, shapes)  # as a page sends it back
    assert [*missing(plan)] == ["mission-one"]
    assert '"1"' not in plan.export_toml(["mission-one"], only_failed=True)
    plan.replace(plan.revision, [{**shapes[0], "trips": shapes[0]["trips"][:3]}, *shapes[1:]])
    with pytest.raises(BadInput, match='"mission-one" has not failed, or was changed since'):
        missing(plan, ["mission-one"])
    plan.launched(["mission-two"])
    plan.settle({"mission-two": "COMPLETED"}, {"mission-two": ["1"]})
    with pytest.raises(BadInput, match='"mission-two" was completed: nothing of it is missing'):
        missing(plan, ["mission-two"])


def test_what_was_done_before_counts_though_it_is_said_twice_that_it_flies() -> None:
    plan = failed(drawn(long("mission-one")), mission_one=["1"])
    plan.launched(["mission-one"], only_failed=True)
    plan.launched(["mission-one"])
    plan.settle({"mission-one": "FAILED"}, {"mission-one": []})
    assert missing(plan) == {"mission-one": ["2", "3", "4", "5", "6"]}


def test_missions_in_rounds_are_flown_whole() -> None:
    plan = failed(drawn({**long("mission-one"), "repeat": 2}), mission_one=["1"])
    with pytest.raises(BadInput, match='"mission-one" flies in rounds'):
        missing(plan)
