"""What a GapMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.flight import Limit, outcome
from plutoc_runtime.words import duration

if TYPE_CHECKING:
    from plutoc_runtime.run import Run
    from plutoc_runtime.status import Status


async def watch_gap(
    run: Run[Any], status: Status, *, default: float | None, gap: float | None
) -> Status:
    """Wait for the trip's end, and fail the trip when its action is overdue."""
    flight, longest = run.state.flight, default if gap is None else gap
    limit = None
    if flight is not None and longest:
        since = flight.launched_at if flight.retry else run.state.last_action_end
        if since is not None:
            reason = (
                f"the action of trip {flight.trip.name} was not done within {duration(longest)} "
                "of the previous one"
            )
            limit = Limit(until=since + longest, reason=reason)
    return await outcome(run.core, run.state, run.key, limit)
