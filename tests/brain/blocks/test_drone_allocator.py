"""DroneAllocator: a mission waits for a drone, but no longer than it may."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.status import FAILED, Status
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from tests.kit import apps


def two(*xs: float, **how: Any) -> apps.SimulationResult:
    """Fly two missions with one drone."""
    return apps.flown(
        *(apps.mission(n, apps.trip(n, x)) for n, x in zip("ab", xs, strict=True)), **how
    )


def test_a_mission_that_waits_too_long_for_a_drone_fails() -> None:
    outcome = two(10.0, 3.0, within=10.0)
    one, other = outcome.missions
    assert one.status is Status.COMPLETED
    assert other.reason == "trip b had no drone within 10 s: waits for a drone (1 busy)"
    assert apps.moments(outcome, "mission.ended")["b"] == 10.0


def test_a_drone_that_is_free_is_given_even_to_who_does_not_wait() -> None:
    assert apps.flown(apps.mission("m", apps.trip("A", 3.0)), within=0.0).completed


def test_a_drone_that_comes_free_at_the_very_limit_is_given() -> None:
    (second,) = two(3.0, 3.0).missions[1].completed_trips
    exact = float(str(second.start_time))
    assert two(3.0, 3.0, within=exact).completed
    assert not two(3.0, 3.0, within=exact - 0.001).completed


def test_who_has_left_the_queue_gets_no_drone_any_more() -> None:
    outcome = two(10.0, 3.0, within=10.0)
    assert [e["mission"] for e in apps.events(outcome, "trip.allocated")] == ["a"]
    assert outcome.drones[0].status.value == "FREE"


def test_a_trip_that_failed_is_put_back_where_the_graph_leads_it_here() -> None:
    """Without a PriorityManager, as a further attempt."""
    mission = apps.mission("m", apps.trip("A", 3.0))

    async def again(run: Any, status: Status) -> Status:
        ended = await apps.watched(run, status)
        if ended is FAILED and run.mission.attempts < 3:
            status = await apps.allocated(run, ended)
            return await again(run, apps.launched(run, status))
        return ended

    outcome = apps.flown(mission, watch=again, faults=Faults(action=1.0))
    assert [e["attempt"] for e in apps.events(outcome, "trip.launched")] == [1, 2, 3]
    assert outcome.count("trip.reset") == 2


@pytest.mark.parametrize("fail_late", [False, True])
@pytest.mark.parametrize(("within", "first"), [(50.0, 20.0), (15.0, 15.0)])
def test_of_a_deadline_and_a_limit_the_first_counts(
    fail_late: bool, within: float, first: float
) -> None:
    missions = apps.mission("a", apps.trip("1", 19.0, 19.0)), apps.mission("b", apps.trip("1", 3.0))
    missions[1].promises = {"deadline": 20.0}
    outcome = apps.flown(*missions, within=within, fail_late=fail_late)
    assert apps.moments(outcome, "mission.ended")["b"] == (first if fail_late else within)


def test_a_drone_that_was_allocated_and_never_flew_is_there_for_others() -> None:
    """What stands between the allocator and the launcher has failed."""

    def fails(mission: apps.Mission, context: object) -> None:
        if mission.name == "a":
            raise ValueError("no")

    async def flow(run: Run[apps.Mission]) -> Status:
        status = await apps.allocated(run, create_mission(run, Status.UNEXECUTED))
        status = await modify_mission(run, status, hook=fails)
        return await apps.watched(run, apps.launched(run, status))

    missions = [apps.mission(name, apps.trip("1", 3.0)) for name in "ab"]
    outcome = apps.fly(apps.app(flow), *missions)
    assert [mission.status.value for mission in outcome.missions] == ["FAILED", "COMPLETED"]
    assert apps.moments(outcome, "trip.launched") == {"b": 0.0}
