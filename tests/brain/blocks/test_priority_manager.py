"""PriorityManager: a failed trip is tried again, before others, as often as it may fly."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow import asking
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Verdict
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_evaluator.step import evaluate_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.priority_manager.step import raise_priority
from tests.kit import apps

ANY_END = (Status.STANDBY, Status.COMPLETED, Status.FAILED)


def attempts(outcome: apps.SimulationResult) -> list[tuple[object, object]]:
    """Return the trips that were launched, and as which attempt."""
    return [(event["trip"], event["attempt"]) for event in apps.events(outcome, "trip.launched")]


@pytest.mark.parametrize("most", [1, 2, 4])
def test_a_trip_flies_no_more_often_than_it_may(most: int) -> None:
    mission = apps.mission("m", apps.trip("A", 3.0), apps.trip("B", 3.0))
    outcome = apps.flown(mission, attempts=most, faults=Faults(action=1.0))
    assert attempts(outcome) == [("A", n + 1) for n in range(most)]
    assert mission.status is Status.FAILED
    assert mission.reason.startswith("take_photo failed: cf1 could not do it at")
    assert mission.trips[0].priority == most - 1


def test_a_failed_trip_comes_before_those_that_wait() -> None:
    """And what was put back has no reason any more."""
    missions = [
        apps.mission(name, apps.trip("A", x), safe_time=12.0)
        for name, x in zip("abc", (15.0, 2.0, 2.0), strict=True)
    ]
    outcome = apps.flown(*missions, attempts=2, watch=apps.timed)
    assert [e["mission"] for e in apps.events(outcome, "trip.launched")] == ["a", "a", "b", "c"]


def test_the_reason_of_a_failure_is_gone_when_its_trip_was_put_back() -> None:
    seen: list[tuple[str, str, str]] = []

    def look(mission: Any, context: object) -> None:
        seen.append((mission.status.value, mission.reason, mission.current.reason))

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        if status is Status.FAILED:
            status = raise_priority(run, status, max_attempts=2, priority=0)
            await modify_mission(run, status, hook=look)
        return status

    apps.flown(apps.mission("m", apps.trip("A", 3.0)), watch=watch, faults=Faults(action=1.0))
    (status, reason, of_trip), _ = seen
    assert (status, reason) == ("STANDBY", "")
    assert of_trip.startswith("take_photo failed"), "why it failed the last time is still told"


def test_a_failure_before_the_launch_counts_as_no_attempt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only flights count; a modifier that fails every time is stopped by the number of its calls."""
    monkeypatch.setattr(asking, "MOST_CALLS", 10)
    asked: list[int] = []

    def never(mission: Any, context: object) -> Status:
        asked.append(mission.current.attempt)
        return Status.FAILED

    async def flow(run: Run[Any]) -> Status:
        status = create_mission(run, Status.UNEXECUTED)
        while True:
            status = await modify_mission(run, status, hook=never, emits=(Status.FAILED,))
            status = raise_priority(run, status, max_attempts=3, priority=0)
            if status is Status.FAILED:
                return status

    (mission,) = apps.fly(apps.app(flow), apps.mission("m", apps.trip("A", 3.0))).missions
    assert "it goes round in its graph for ever" in mission.reason
    assert asked == [1] * 10


@pytest.mark.parametrize("max_attempts", [1, 3])
def test_a_failure_after_another_trips_end_is_charged_to_no_trip(max_attempts: int) -> None:
    """The hook fails the mission once, when A is over; B has not flown, and flies as attempt 1."""
    said: list[Status] = []

    def once(mission: Any, context: object) -> Status:
        said.append(Status.FAILED if not said else mission.status)
        return said[-1]

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        status = await modify_mission(run, status, hook=once, emits=ANY_END)
        if status is Status.FAILED:
            return raise_priority(run, status, max_attempts=max_attempts, priority=0)
        return status

    mission = apps.mission("m", apps.trip("A", 3.0), apps.trip("B", 5.0))
    outcome = apps.flown(mission, watch=watch)
    assert outcome.completed
    assert attempts(outcome) == [("A", 1), ("B", 1)]


def test_a_trip_that_flew_and_failed_is_charged_once_though_hooks_say_otherwise_then() -> None:
    """It failed in flight, was put back, and a hook failed the mission again before it flew."""
    said: list[int] = []

    def twice(mission: Any, context: object) -> Status:
        said.append(mission.current.attempt)
        return Status.FAILED

    async def watch(run: Run[Any], status: Status) -> Status:
        for _ in range(3):
            status = await modify_mission(run, status, hook=twice, emits=(Status.FAILED,))
            status = raise_priority(run, status, max_attempts=2, priority=0)
        return status

    outcome = apps.flown(apps.mission("m", apps.trip("A", 3.0)), watch=watch)
    assert outcome.missions[0].status is Status.FAILED
    assert said == [1, 2, 2, 2, 2, 2]
    assert attempts(outcome) == [("A", 1), ("A", 2)]


def test_nothing_is_put_back_where_no_trip_is_left() -> None:
    """A PriorityManager behind an evaluator's FAILED ends the mission, and says both reasons."""

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        status = await evaluate_mission(
            run, status, hook=lambda mission, results: Verdict(fail="too dry"), evaluator=None
        )
        raise_priority(run, status, max_attempts=3, priority=0)
        raise AssertionError("it went on")

    (mission,) = apps.flown(apps.mission("m", apps.trip("A", 3.0)), watch=watch).missions
    assert (mission.status, mission.reason) == (Status.FAILED, "too dry; no trip is left to fly")
