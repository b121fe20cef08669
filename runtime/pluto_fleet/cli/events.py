"""What happened, one line an event, for a person who watches."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from plutoc_runtime.domain.text import printable

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event


def line_of(event: Event) -> str | None:
    """Return the line for an event; None for what only a machine wants to know."""
    said = sentence_of(event)
    if said is None:
        return None
    time = f"{float(str(event['t'])):>8.1f} s  "
    mission = event.get("mission")
    text = f"{mission}: {said}" if mission else said
    first, *rest = text.split("\n")  # a hook's traceback has many lines
    return "\n".join([time + printable(first), *(" " * len(time) + printable(r) for r in rest)])


def sentence_of(event: Event) -> str | None:
    """Return what happened, without when and to which mission; None: only a machine cares."""
    say = _SENTENCES.get(str(event["event"]))
    return None if say is None else say(event)


def _launched(event: Event) -> str:
    again = ", again" if event.get("attempt", 1) != 1 else ""
    return f"trip {event['trip']} launched{again} ({event['drone']})"


def _completed(event: Event) -> str:
    return f"trip {event['trip']} completed ({event['drone']})"


def _failed(event: Event) -> str:
    return f"trip {event['trip']} failed ({event['drone']}): {event['reason']}"


def _extended(event: Event) -> str:
    told = [
        f"{what}: {', '.join(str(trip) for trip in trips)}"
        for what, trips in (("again", event.get("redo")), ("new", event.get("add")))
        if isinstance(trips, list) and trips
    ]
    return f"goes on with more trips ({'; '.join(told)})"


def _ended(event: Event) -> str:
    reason = event.get("reason")
    return f"{event['status']}: {reason}" if reason else str(event["status"])


def _brought_back(event: Event) -> str:
    said = "was lost, and a person has looked after it" if event.get("lost") else "is back"
    return f"{event['drone']} {said}"


def _lost(event: Event) -> str:
    reason = event.get("reason")
    return f"{event['drone']} is lost" + (f": {reason}" if reason else "")


_HOW = {"rtl": "all fly home", "land": "all land"}

_SENTENCES: Mapping[str, Callable[[Event], str]] = {
    "trip.launched": _launched,
    "trip.completed": _completed,
    "trip.failed": _failed,
    "mission.repeated": lambda event: f"round {int(str(event['round'])) + 1} begins",
    "mission.extended": _extended,
    "mission.ended": _ended,
    "mission.paused": lambda _: "paused",
    "mission.resumed": lambda _: "goes on",
    "mission.uncertain": lambda event: f"waits for a person: {event['reason']}",
    "mission.held": lambda event: f"is held until a person decides: {event['reason']}",
    "mission.decided": lambda event: f"a person has decided: {event['answer']}",
    "trip.interrupted": lambda event: f"trip {event['trip']} interrupted; it will be flown again",
    "trip.skipped": lambda event: f"trip {event['trip']} skipped",
    "trip.prioritised": lambda event: f"trip {event['trip']} has priority {event['priority']}",
    "drone.retired": lambda event: f"{event['drone']} is retired",
    "drone.brought_back": _brought_back,
    "drone.not_ready": lambda event: f"{event['drone']} is not ready: {event['reason']}",
    "stopped": lambda event: f"everything stops ({_HOW.get(str(event['how']), event['how'])})",
    "drone.recovering": lambda event: f"{event['drone']} recovers",
    "drone.lost": _lost,
    "log": lambda event: str(event["text"]),
}
