"""What a GapMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.text import duration
from plutoc_runtime.flow.flight import Limit
from plutoc_runtime.flow.run import watch

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Trip
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


async def watch_gap(
    run: Run[Any], status: Status, *, default: float | None = None, gap: float | None
) -> Status:
    """Wait for the trip's end, and fail the trip when its action is overdue."""
    return await watch(run, gap_limit(run, default=default, gap=gap))


def gap_limit(run: Run[Any], *, default: float | None = None, gap: float | None) -> Limit | None:
    """Return the limit of the trip in flight, from the action before it on; None: it has none."""
    state, longest = run.state, default if gap is None else gap
    flight = state.flight
    if flight is None or not longest:
        return None
    since = flight.launched_at if flight.retry else state.last_action_end
    return None if since is None else Limit(since, longest, _overdue)


def _overdue(trip: Trip, longest: float) -> str:
    return (
        f"the action of trip {trip.name} was not done within {duration(longest)} "
        "of the previous one"
    )
