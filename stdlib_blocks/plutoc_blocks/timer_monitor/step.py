"""What a TimerMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.text import duration
from plutoc_runtime.flow.flight import Limit
from plutoc_runtime.flow.run import watch

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Trip
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


async def watch_timer(
    run: Run[Any], status: Status, *, default: float | None = None, safe_time: float | None
) -> Status:
    """Wait for the trip's end, and fail the trip at its safe time."""
    return await watch(run, timer_limit(run, default=default, safe_time=safe_time))


def timer_limit(
    run: Run[Any], *, default: float | None = None, safe_time: float | None
) -> Limit | None:
    """Return the limit of the trip in flight, from its start on; None: it has none."""
    flight, safe = run.state.flight, default if safe_time is None else safe_time
    if flight is None or not safe:
        return None
    return Limit(flight.launched_at, safe, _too_long)


def _too_long(trip: Trip, safe: float) -> str:
    return f"trip {trip.name} took longer than its safe time of {duration(safe)}"
