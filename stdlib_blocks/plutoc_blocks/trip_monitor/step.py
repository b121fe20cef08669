"""What a TripMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.flow.run import watch

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


async def watch_trip(run: Run[Any], status: Status) -> Status:
    """Wait for the trip's end."""
    return await watch(run)
