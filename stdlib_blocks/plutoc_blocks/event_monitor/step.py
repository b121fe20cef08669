"""What an EventMonitor does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.events.raising import Events
from plutoc_runtime.flow.run import watch

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.events.interruption import Whose
    from plutoc_runtime.flow.flight import Limit
    from plutoc_runtime.flow.run import Run


async def watch_event(run: Run[Any], status: Status, *, event: str, of: Whose) -> Status:
    """Wait for the trip's end, and break the flight off when the event comes."""
    event_limit(run, event=event, of=of)
    return await watch(run)


def event_limit(run: Run[Any], *, event: str, of: Whose) -> Limit | None:
    """Have the event break the flight off, which is no limit in time."""
    events: Events = run.core.parts[Events]
    events.interrupt(run, event, of)
    return None
