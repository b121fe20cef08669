"""What a Clock does."""

from __future__ import annotations

from math import ceil, isfinite
from typing import TYPE_CHECKING, Any

from plutoc_runtime.time.kernel import EventKind

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run

DAY = 86_400.0


async def wait_for_time(
    run: Run[Any], status: Status, *, block: str, delay: float | None
) -> Status:
    """Wait until the next trip's delay is over, and until its round may begin."""
    kernel, mission, state = run.core.kernel, run.mission, run.state
    run.meets(block)
    if state.goes_on:
        return status  # it was interrupted after its launch
    trip = mission.current
    place = (block, trip.name, mission.round, trip.attempt)
    arrival = kernel.now
    if state.delay is not None and state.delay[0] == place:
        over, begins = state.delay[1:]  # it waited here when it was interrupted
    else:
        waited = state.waited is not None and place in state.waited
        over = arrival if waited else arrival + (delay or 0.0)
        begins = _begins(run)
    until = max(over, begins)
    if until > arrival:
        state.delay = (place, over, begins)
        if run.core.trace.live:
            run.core.trace.note(
                "trip.delayed",
                mission=mission.name,
                trip=trip.name,
                until=until,
                over=over,
                begins=begins,
                block=block,
                resumes_at=state.at,
            )
        await kernel.sleep(until - arrival, EventKind.CLOCK, run.key)
    state.delay = None
    if state.waited is None:
        state.waited = set()
    state.waited.add(place)
    if state.first_start is None:
        state.first_start = kernel.now
    return status


def _begins(run: Run[Any]) -> float:
    """Return when its round may begin: a time of day, or a multiple since the first start."""
    kernel, mission, first_start = run.core.kernel, run.mission, run.state.first_start
    arrival = kernel.now
    at: float | None = mission.at
    every: float | None = mission.every
    if mission.completed_trips or mission.current.attempt > 1:
        return 0.0
    if mission.round == 0 and at is not None and first_start is None:
        return arrival + (at - kernel.time_of_day) % DAY
    if mission.round > 0 and every and first_start is not None:
        rounds = (arrival - first_start) / every
        # a hook may have made it as short as it likes: then the next round begins at once
        return first_start + ceil(round(rounds, 9)) * every if isfinite(rounds) else arrival
    return 0.0
