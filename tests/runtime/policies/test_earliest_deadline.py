"""`earliest_deadline`: who is due first goes first, unless that is too late already."""

from __future__ import annotations

from collections.abc import Coroutine
from typing import Any

from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.earliest_deadline import earliest_deadline
from pluto_fleet.shared.flow.run import Run
from tests.deadlines import SHARE, results
from tests.runtime import apps


def order(
    deadlines: dict[str, float | None], priorities: dict[str, int] | None = None
) -> list[tuple[str, str]]:
    """Return the order in which one drone flies missions, and why."""
    inner = apps.flow(policy=earliest_deadline)

    def flow(run: Run[apps.Mission]) -> Coroutine[Any, Any, Status]:
        run.mission.deadline = deadlines[run.mission.name]
        return inner(run)

    missions = [
        apps.mission(name, apps.trip("A", 3.0, priority=(priorities or {}).get(name, 0)))
        for name in deadlines
    ]
    outcome = apps.fly(apps.app(flow), *missions)
    return [
        (str(e["mission"]), str(e["why"]).partition(";")[0])
        for e in apps.events(outcome, "trip.allocated")
    ]


def test_the_earliest_goes_first_and_one_without_goes_last() -> None:
    flown = order({"a": None, "b": 900.0, "c": 300.0, "d": 600.0})
    assert [name for name, _ in flown] == ["c", "d", "b", "a"]
    assert flown[0][1] == "due in 300 s"
    assert flown[3][1] == "no deadline"


def test_of_equals_it_is_the_one_that_came_first() -> None:
    assert [name for name, _ in order({"a": 300.0, "b": 300.0, "c": 300.0})] == ["a", "b", "c"]


def test_a_higher_priority_comes_before_any_deadline() -> None:
    assert [name for name, _ in order({"a": 100.0, "b": None}, {"b": 1})] == ["b", "a"]


def test_what_is_too_late_already_keeps_none_waiting_that_can_be_in_time() -> None:
    assert [name for name, _ in order({"a": 5.0, "b": None, "c": 60.0})] == ["c", "a", "b"]


def test_it_misses_no_more_than_nearest_in_nearly_all_plans() -> None:
    """A share of the campaign."""
    found = list(results(25))
    assert sum(after <= before for before, after in found) >= SHARE * len(found)
    assert sum(after for _, after in found) < 0.75 * sum(before for before, _ in found)
