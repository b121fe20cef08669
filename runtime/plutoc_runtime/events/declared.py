"""Events as an app declares them, and their occurrences as hooks see them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..domain.actions import Parameter
    from ..domain.model import Point

LATE = "late"
"""Happens when a promise of a mission is broken."""
LOST = "lost"
"""Happens when a drone is lost."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """One occurrence of an event; what is not known of it is None."""

    id: str
    """With the same one it happens only once."""
    name: str
    time: float
    """When it was raised, in seconds since the app started."""
    at: Point | None = None
    """Where it happened: metres in the map's frame."""
    track: str | None = None
    """The moving object that it is about."""
    mission: str | None = None
    """The mission whose hook or drone has raised it."""
    trip: str | None = None
    """That mission's trip."""
    drone: str | None = None
    """That trip's drone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EventType:
    """An event that an app declares, or a built-in one."""

    name: str
    type: type[Event] = Event
    fields: tuple[Parameter, ...] = ()
    """Those of its own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Creator:
    """What makes a mission of an event, and the block at which that mission begins."""

    event: str
    block: str
    hook: Callable[..., Any]


def facts_of(event: Event) -> dict[str, Any]:
    """Return an occurrence as plain data."""
    facts = ((field.name, getattr(event, field.name)) for field in fields(event))
    return {name: value for name, value in facts if value is not None}


def event_of(kind: EventType, facts: Mapping[str, Any]) -> Event:
    """Return an occurrence from its plain data."""
    at = facts.get("at")
    return kind.type(**{**facts, "at": None if at is None else tuple(at)})
