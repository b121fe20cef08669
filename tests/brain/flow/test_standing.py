"""What goes wrong in a running app is told with the block in which it did."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.fleet.policies import Policy, nearest
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.gate_fifo.step import pass_first
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.step import watch_trip
from tests.kit import apps


def fly(
    step: Callable[..., Any], hook: Callable[..., Any], policy: Policy = nearest
) -> SimulationResult:
    """Fly one trip, with a block of another author's and a modifier in a fork behind it."""

    async def flow(run: Run[apps.Mission]) -> Status:
        # create = MissionCreator
        status = create_mission(run, Status.UNEXECUTED)
        # allocate = DroneAllocator(policy: choose)
        status = await allocate_drone(
            run, status, block="allocate", policy=policy, allocate_within=None
        )
        # launch = TripLauncher
        status = launch_trip(run, status)
        # launch -> [watch_too, watch] -> first = GateFIFO
        status = await pass_first(run, status, wild, watch_trip)
        if status is Status.COMPLETED:
            # note = MissionModifier(hook: note)
            return await modify_mission(run, status, hook=hook)
        return status

    async def wild(run: Run[Any], status: Status) -> Status:
        # watch_too = TripMonitor
        status = await watch_trip(run, status)
        # wild = zoo.Wild
        step(run)
        return status

    return apps.fly(apps.app(flow), apps.mission("M", apps.trip("A", 3.0)))


def nothing(*_: object) -> None:
    """Do nothing, as a step or as a modifier."""


def broken(*_: object) -> None:
    """Fail, as a step, as a modifier or as a policy."""
    raise ZeroDivisionError("by accident")


def log_of(outcome: SimulationResult) -> str:
    """Return what was logged."""
    return "\n".join(outcome.log)


def test_an_unexpected_error_names_the_block() -> None:
    """A block's step in a branch of a fork fails: that is a mistake of ours or of its maker."""
    with pytest.raises(ZeroDivisionError) as raised:
        fly(broken, nothing)
    assert raised.value.__notes__ == ["in block wild = zoo.Wild"]


def test_the_log_says_which_block_called_a_hook_that_failed() -> None:
    """Behind the hook's traceback."""
    outcome = fly(nothing, broken)
    assert outcome.missions[0].status is Status.FAILED
    assert 'raise ZeroDivisionError("by accident")' in log_of(outcome)
    assert log_of(outcome).endswith("in block note = MissionModifier(hook: note)")


def test_the_log_has_the_traceback_of_a_policy_too() -> None:
    """A policy is asked by the queue, and its fault comes out of the block that waits there."""
    outcome = fly(nothing, nothing, policy=own_policy(broken))
    assert outcome.missions[0].reason == "policy broken raised ZeroDivisionError: by accident"
    assert 'raise ZeroDivisionError("by accident")' in log_of(outcome)
    assert log_of(outcome).endswith("in block allocate = DroneAllocator(policy: choose)")
