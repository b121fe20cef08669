"""What a DroneAllocator does."""

from __future__ import annotations

from collections.abc import Generator
from functools import partial
from math import inf
from types import coroutine
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import MissionFailed, nothing_to_fly
from plutoc_runtime.domain.keeper import trips_of
from plutoc_runtime.domain.status import FAILED, STANDBY, Status
from plutoc_runtime.domain.text import duration
from plutoc_runtime.time.kernel import EventKind

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.fleet.policies import Policy
    from plutoc_runtime.fleet.queue import Request
    from plutoc_runtime.flow.run import Run


@coroutine
def allocate_drone(
    run: Run[Any],
    status: Status,
    *,
    block: str,
    policy: Policy,
    allocate_within: float | None = None,
    fail_late: bool = False,
    priority: int = 0,
) -> Generator[Any, Any, Status]:
    """Wait for a drone for the next trip; the mission keeps one that carries its item.

    Many wait here at once. So it awaits by itself, and does not need another object for that.
    """
    core, mission, state = run.core, run.mission, run.state
    run.meets(block)
    if state.goes_on:
        return status  # it was interrupted after its launch
    trips = trips_of(mission)
    if not trips:
        raise nothing_to_fly(mission.reason)
    if status is FAILED:
        core.transitions.put_back(mission)
        status = STANDBY
    trip = trips[0]
    drone = state.allocated
    why = "allocated before"
    if drone is None:
        drone, why = state.carrier, "carries the mission's item"
    if drone is None:
        if fail_late and mission.late:
            raise MissionFailed(f"it is late: its deadline has passed before trip {trip.name}")
        request = core.queue.enter(mission, policy, priority)
        request.hurries = allocate_within is not None
        try:
            if fail_late and mission.deadline is not None:
                yield from _in_time(run, request, allocate_within)
            elif allocate_within is not None:
                yield from _no_longer_than(run, request, allocate_within)
            if not request.is_set:
                yield request
            drone, why = request.result(), request.why
        finally:
            if not request.is_set:
                core.queue.leave(request)
    state.allocated = drone
    core.transitions.allocate(mission, trip, drone, state.at, why)
    return status


async def _in_time(run: Run[Any], request: Request, within: float | None) -> None:
    """Wait until the mission is late, but not longer than any mission waits here."""
    kernel = run.core.kernel
    mission = run.mission
    if within is not None and kernel.now + within < _due(mission):
        await _no_longer_than(run, request, within)
    elif not await kernel.before(request, partial(_due, mission), EventKind.ALLOCATE, run.key):
        raise MissionFailed(f"it is late: trip {request.trip.name} had no drone by its deadline")


def _due(mission: Mission[Any]) -> float:
    return inf if mission.deadline is None else mission.deadline


async def _no_longer_than(run: Run[Any], request: Request, seconds: float) -> None:
    kernel, queue = run.core.kernel, run.core.queue
    # the queue is served first: who gets a drone at that instant has one
    if not await kernel.within(request, kernel.now + seconds, EventKind.ALLOCATE, run.key):
        raise MissionFailed(
            f"trip {request.trip.name} had no drone within {duration(seconds)}: "
            f"waits for a drone ({queue.summary()})"
        )
