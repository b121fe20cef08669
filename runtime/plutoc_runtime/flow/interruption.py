"""Flights that an event breaks off."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..domain.event import Event
    from ..domain.model import Mission
    from .run import Run

Whose = Callable[["Event", "Mission[Any]"], bool]
"""Whether an event concerns a mission."""


def own(event: Event, mission: Mission[Any]) -> bool:
    """Return whether a mission's own hooks or drone have raised an event."""
    return event.mission == mission.name


def anything(event: Event, mission: Mission[Any]) -> bool:
    """Return whether an event has come, whoever raised it."""
    return True


def break_off_at(run: Run[Any], event: str, of: Whose) -> None:
    """Break the flight of this moment off when the event comes, unless it or the branch has ended.

    The trip is WAITING again and no attempt is charged, the drone hovers and stays the mission's, and
    the flight is set to STANDBY. No event is raised yet: then nothing breaks it off.
    """
