"""What goes wrong in a hook is told with the block that asked it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.fleet.policies import Policy, nearest
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.step import watch_trip
from tests.kit import apps


def fly(hook: Callable[..., Any], policy: Policy = nearest) -> SimulationResult:
    """Fly one trip, with a modifier behind it."""

    async def flow(run: Run[apps.Mission]) -> Status:
        # create = MissionCreator
        status = create_mission(run, Status.UNEXECUTED)
        # allocate = DroneAllocator(policy: choose)
        status = await allocate_drone(
            run, status, block="allocate", policy=policy, allocate_within=None
        )
        # launch = TripLauncher
        status = launch_trip(run, status)
        # watch = TripMonitor
        run.state.block = "watch"
        status = await watch_trip(run, status)
        if status is Status.COMPLETED:
            # note = MissionModifier(hook: note)
            run.state.block = "note"
            return await modify_mission(run, status, hook=hook)
        return status

    return apps.fly(apps.app(flow), apps.mission("M", apps.trip("A", 3.0)))


def nothing(*_: object) -> None:
    """Do nothing, as a modifier."""


def broken(*_: object) -> None:
    """Fail, as a modifier or as a policy."""
    raise ZeroDivisionError("by accident")


def log_of(outcome: SimulationResult) -> str:
    """Return what was logged."""
    return "\n".join(outcome.log)


def test_the_log_says_which_block_called_a_hook_that_failed() -> None:
    """Behind the hook's traceback."""
    outcome = fly(broken)
    assert outcome.missions[0].status is Status.FAILED
    assert 'raise ZeroDivisionError("by accident")' in log_of(outcome)
    assert log_of(outcome).endswith("in block note")


def test_the_log_has_the_traceback_of_a_policy_too() -> None:
    """A policy is asked by the queue, and its fault comes out of the block that waits there."""
    outcome = fly(nothing, policy=own_policy(broken))
    assert outcome.missions[0].reason == "policy broken raised ZeroDivisionError: by accident"
    assert 'raise ZeroDivisionError("by accident")' in log_of(outcome)
    assert log_of(outcome).endswith("in block allocate")
