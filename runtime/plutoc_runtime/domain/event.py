"""Events: what happens, and what an app makes of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .app import App

if TYPE_CHECKING:
    from .actions import Parameter
    from .model import Mission, Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """What has happened; an app's own events have fields besides."""

    name: str
    id: str
    """One event of an id happens, over restarts too."""
    time: float
    """When, in seconds since the app started."""
    at: Point | None = None
    """Where, if that is known."""
    track: str | None = None
    """What moves there, if that is tracked."""
    mission: str | None = None
    """The mission whose hook or drone has raised it."""
    trip: str | None = None
    """That mission's trip."""
    drone: str | None = None
    """That trip's drone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EventType:
    """An event that an app declares."""

    name: str
    type: type[Event]
    fields: tuple[Parameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Creator:
    """What makes a mission of an event, and the block at which that mission begins."""

    event: str
    block: str
    hook: Callable[..., Mission[Any] | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class EventApp(App):
    """An app that has to do with events."""

    events: tuple[EventType, ...] = ()
    """Those that it declares."""
    creators: tuple[Creator, ...] = ()
    """In the order in which they are asked."""
