"""What a DroneAllocator does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.capability import chain_of
from plutoc_runtime.errors import MissionFailed
from plutoc_runtime.kernel import FLEET, Kind
from plutoc_runtime.status import Status
from plutoc_runtime.words import duration

if TYPE_CHECKING:
    from plutoc_runtime.policy import Policy
    from plutoc_runtime.run import Run


async def allocate_drone(
    run: Run[Any],
    status: Status,
    *,
    policy: Policy,
    allocate_within: float | None,
    priority: int = 0,
) -> Status:
    """Wait for a drone for the next trip; the mission keeps one that carries its item."""
    core, mission, state = run.core, run.mission, run.state
    if not mission.trips:
        raise MissionFailed(mission.reason or "no trip is left to fly")
    if status is Status.FAILED:
        core.transitions.put_back(mission)
        status = Status.STANDBY
    trip = mission.current
    if state.allocated is not None:
        core.transitions.allocate(mission, trip, state.allocated, "allocated before")
        return status
    if state.carrier is not None:
        core.transitions.allocate(mission, trip, state.carrier, "carries the mission's item")
        state.allocated = state.carrier
        return status
    request = core.fleet.queue.enter(chain_of(mission.trips), policy, priority)
    try:
        if allocate_within is not None:
            until = core.kernel.now + allocate_within
            key = (*FLEET, *run.key)  # after the queue is served: who gets a drone then has one
            if not await core.kernel.within(request.answer, until, Kind.ALLOCATE, key):
                raise MissionFailed(
                    f"trip {trip.name} had no drone within {duration(allocate_within)}: "
                    f"waits for a drone ({core.fleet.queue.standing()})"
                )
        decision = await request.answer
    finally:
        core.fleet.queue.leave(request)
    if decision.drone is None:
        raise RuntimeError("a decision without a drone and without a fault")
    state.allocated = decision.drone
    core.transitions.allocate(mission, trip, decision.drone, decision.why)
    return status
