"""What a Clock does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.time.hours import DAY
from plutoc_runtime.time.kernel import EventKind, Future

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


async def wait_for_time(
    run: Run[Any], status: Status, *, block: str, delay: float | None
) -> Status:
    """Wait until the next trip's delay is over, and until its round may begin."""
    kernel, mission, state = run.core.kernel, run.mission, run.state
    run.meets(block)
    if state.goes_on:
        return status  # it was interrupted after its launch
    trip = run.trip
    place = (block, trip.name, mission.round, trip.attempt)
    arrival = kernel.now
    if state.delay is not None and state.delay[0] == place:
        over, begins = state.delay[1:]  # it waited here when it was interrupted
    else:
        waited = state.waited is not None and place in state.waited
        over = arrival if waited else arrival + (delay or 0.0)
        begins = _begins(run)
    state.delay = (place, over, begins)

    def until() -> float:
        if begins and abs(begins - kernel.clock) > DAY:  # or the clock was wrong by days
            state.delay = (place, over, _begins(run))
        return state.held_until or 0.0

    if until() > arrival:
        run.core.changes.moved_on(mission)
        if run.core.trace.live:
            run.core.trace.note(
                "trip.delayed",
                mission=mission.name,
                trip=trip.name,
                until=until(),
                over=over,
                begins=begins,
                block=block,
                resumes_at=state.at,
            )
        await kernel.before(Future(), until, EventKind.CLOCK, run.key)
    state.delay = None
    if state.waited is None:
        state.waited = set()
    state.waited.add(place)
    if state.first_start is None:
        state.first_start = kernel.clock
    return status


def _begins(run: Run[Any]) -> float:
    """Return when its round may begin by the clock: at an hour, or at a multiple since the first start."""
    kernel, mission, first_start = run.core.kernel, run.mission, run.state.first_start
    at: float | None = mission.at
    every: float | None = mission.every
    if mission.completed_trips or run.trip.attempt > 1:
        return 0.0
    if mission.round == 0 and at is not None and first_start is None:
        return kernel.hours.next(at, kernel.clock)
    if mission.round > 0 and every and first_start is not None:
        return kernel.hours.again(first_start, every, kernel.clock)
    return 0.0
