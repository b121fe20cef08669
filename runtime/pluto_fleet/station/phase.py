"""What goes on at a station."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

from ..flight.config import End

if TYPE_CHECKING:
    from .session import Outing


class Phase(Enum):
    """Whether anything flies, and what can be done next."""

    IDLE = "idle"
    FLYING = "flying"
    STOPPING = "stopping"
    """All drones are coming down."""
    STOPPED = "stopped"
    """Somebody has stopped it: it can be resumed, or put away."""
    INTERRUPTED = "interrupted"
    """It has ended otherwise than it should: the same."""
    OVER = "over"
    """Every mission has ended."""


def phase_of(outing: Outing | None) -> Phase:
    """Return what goes on, by the flight there is."""
    if outing is None:
        return Phase.IDLE
    if outing.lives:
        return Phase.STOPPING if outing.stops.asked is not None else Phase.FLYING
    if outing.trouble:
        return Phase.INTERRUPTED
    match outing.end:
        case End.OVER:
            return Phase.OVER
        case End.STOPPED:
            return Phase.STOPPED
    was_stopped = outing.records is not None and outing.records.stopped
    return Phase.STOPPED if was_stopped else Phase.INTERRUPTED
