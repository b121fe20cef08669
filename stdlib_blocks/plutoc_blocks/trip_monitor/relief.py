"""What a TripMonitor does that has another drone take over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.events.relief import relieve_at
from plutoc_runtime.flow.run import watch

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.flight import Limit
    from plutoc_runtime.flow.run import Run


async def watch_relieved(run: Run[Any], status: Status, *, relief: float) -> Status:
    """Wait for the trip's end, by whichever drone."""
    relieve(run, relief=relief)
    return await watch(run)


def relieve(run: Run[Any], *, relief: float) -> Limit | None:
    """Have another drone take the flight over, which is no limit in time."""
    relieve_at(run, relief)
    return None
