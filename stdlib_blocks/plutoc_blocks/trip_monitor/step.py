"""What a TripMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.watching import watch

if TYPE_CHECKING:
    from plutoc_runtime.run import Run
    from plutoc_runtime.status import Status


async def watch_trip(run: Run[Any], status: Status) -> Status:
    """Wait for the trip's end."""
    return await watch(run)
