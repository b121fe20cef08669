"""What every app can name without declaring it: actions and events."""

from __future__ import annotations

from plutoc.graph.model import Event
from plutoc_runtime.domain.actions import BUILT_IN
from plutoc_runtime.events.follow import FOLLOW

ACTIONS = {**BUILT_IN, FOLLOW.name: FOLLOW}
"""The built-in actions. A package has `follow` only where its drones can follow."""

ALONG = tuple(name for name, action in BUILT_IN.items() if action.repeat == "safe")
"""Those that can be done on the way."""

EVENTS = {
    "late": "A promise of a mission is broken: a deadline, or a window.",
    "lost": "A drone is lost.",
}
"""The built-in events, with what they mean. A block may have such a name, and hides the event."""


def event(name: str) -> Event:
    """Return a built-in event."""
    return Event(name=name)
