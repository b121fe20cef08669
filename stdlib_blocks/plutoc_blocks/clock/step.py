"""What a Clock does."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, Any

from plutoc_runtime.kernel import Kind

if TYPE_CHECKING:
    from plutoc_runtime.run import Run
    from plutoc_runtime.status import Status

DAY = 86_400.0


async def wait_for_time(
    run: Run[Any],
    status: Status,
    *,
    block: str,
    at: float | None,
    every: float | None,
    delay: float | None,
) -> Status:
    """Wait until the next trip's delay is over, and until its round may begin."""
    kernel, mission, state = run.core.kernel, run.mission, run.state
    trip = mission.current
    place = (block, trip.name, mission.round, trip.attempt)
    arrival = kernel.now
    until = arrival
    if state.waited is None or place not in state.waited:
        until += delay or 0.0
    if not mission.completed_trips and trip.attempt == 1:
        if mission.round == 0 and at is not None and state.first_start is None:
            until = max(until, arrival + (at - kernel.time_of_day) % DAY)
        if mission.round > 0 and every and state.first_start is not None:
            rounds = ceil(round((arrival - state.first_start) / every, 9))
            until = max(until, state.first_start + rounds * every)
    if until > arrival:
        if run.core.trace.live:
            run.core.trace.note("trip.delayed", mission=mission.name, trip=trip.name, until=until)
        await kernel.sleep(until - arrival, Kind.CLOCK, run.key)
    if state.waited is None:
        state.waited = set()
    state.waited.add(place)
    if state.first_start is None:
        state.first_start = kernel.now
    return status
