"""What a TimerMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.flight import Limit, outcome
from plutoc_runtime.words import duration

if TYPE_CHECKING:
    from plutoc_runtime.run import Run
    from plutoc_runtime.status import Status


async def watch_timer(
    run: Run[Any], status: Status, *, default: float | None, safe_time: float | None
) -> Status:
    """Wait for the trip's end, and fail the trip at its safe time."""
    flight, safe = run.state.flight, default if safe_time is None else safe_time
    limit = None
    if flight is not None and safe:
        reason = f"trip {flight.trip.name} took longer than its safe time of {duration(safe)}"
        limit = Limit(until=flight.launched_at + safe, reason=reason)
    return await outcome(run.core, run.state, run.key, limit)
