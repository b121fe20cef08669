"""The sentences of a journal: those of `events.py`, and what only matters afterwards."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from plutoc_runtime.domain.text import duration, printable

from .events import line_of

Fact = Mapping[str, Any]


def told(event: Fact, wall: float) -> str | None:
    """Say what an event was; an event of another version, with other facts, as plain facts."""
    try:
        if event["event"] == "journal.begun":
            return _begun(event, wall)
        say = _SENTENCES.get(event["event"])
        if say is None:
            line = line_of(event)
            return line if line is not None else _plain(event)
        mission = event.get("mission")
        text = f"{mission}: {say(event)}" if mission else say(event)
        return f"{float(event['t']):>8.1f} s  {printable(text)}"
    except (LookupError, TypeError, ValueError, AttributeError):
        return _plain(event)


def _plain(event: Fact) -> str:
    facts = ", ".join(f"{name} {value}" for name, value in event.items() if name not in _HEAD)
    name = str(event.get("event", "an event"))
    time = event.get("t")
    begin = f"{time:>8.1f} s  " if isinstance(time, (int, float)) else " " * 12
    return begin + printable(f"{name}: {facts}" if facts else name)


_HEAD = ("t", "event")


def _begun(event: Fact, wall: float) -> str:
    day = time.strftime("%Y-%m-%d", time.localtime(wall))
    how = f"simulated drones, seed {event['seed']}" if event["sim"] else "real drones"
    return printable(f"journal of {event['app']}, begun on {day} ({how})")


def _created(event: Fact) -> str:
    return f"has trips {', '.join(str(trip) for trip in event['trips'])}"


def _changed(event: Fact) -> str:
    trips = ", ".join(str(trip["name"]) for trip in event["todo"]) or "none"
    return f"was changed by the app's own code; trips to do: {trips}"


def _allocated(event: Fact) -> str:
    return f"trip {event['trip']} gets {event['drone']}: {event['why']}"


def _delayed(event: Fact) -> str:
    rest = float(event["until"]) - float(event["t"])
    return f"trip {event['trip']} waits {duration(max(rest, 0.0))}"


def _modified(event: Fact) -> str:
    why = f": {event['reason']}" if event.get("reason") else ""
    return f"a modifier makes it {event['status']}{why}"


def _drone(what: str) -> Callable[[Fact], str]:
    return lambda event: f"{event['drone']} {what}"


_SENTENCES: Mapping[str, Callable[[Fact], str]] = {
    "brain.began": lambda event: "the app begins" if event["epoch"] == 1 else "the app goes on",
    "mission.created": _created,
    "mission.changed": _changed,
    "mission.modified": _modified,
    "mission.judged": lambda event: f"was judged and found wanting: {event['reason']}",
    "trip.allocated": _allocated,
    "trip.delayed": _delayed,
    "trip.reset": lambda event: f"trip {event['trip']} waits for attempt {event['attempt']}",
    "action.begun": lambda event: f"the action of trip {event['trip']} begins ({event['drone']})",
    "drone.free": _drone("is free"),
    "drone.busy": _drone("stays with its mission"),
    "drone.returning": _drone("returns home"),
    "drone.charging": _drone("charges"),
    "drone.offline": _drone("does not answer"),
}
