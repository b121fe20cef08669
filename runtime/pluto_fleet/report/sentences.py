"""The events of a flight as sentences, one for each."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..jobs.flown import ACTS_BESIDE, FLEW
from ..shared.domain.text import duration, number, percent, place, printable

if TYPE_CHECKING:
    from ..shared.domain.trace import Event


def line_of(event: Event) -> str | None:
    """Return the line for an event; None for one that is of no interest to people."""
    said = sentence_of(event)
    if said is None:
        return None
    time = f"{float(str(event['t'])):>8.1f} s  "
    mission = event.get("mission")
    text = f"{mission}: {said}" if mission else said
    first, *rest = text.split("\n")  # a hook's traceback has many lines
    return "\n".join([time + printable(first), *(" " * len(time) + printable(r) for r in rest)])


def sentence_of(event: Event) -> str | None:
    """Return an event's sentence, without time and mission; None: it is of no interest to people."""
    say = _SENTENCES.get(str(event["event"]))
    return None if say is None else say(event)


def _launched(event: Event) -> str:
    again = ", again" if event.get("attempt", 1) != 1 else ""
    return f"trip {event['trip']} launched{again} ({event['drone']})"


def _completed(event: Event) -> str:
    return f"trip {event['trip']} completed ({event['drone']})"


def _beside(event: Event) -> str:
    at: Any = event["at"]
    where = f"{place(at)} at a height of {number(at[2])} m"
    return (
        f"trip {event['trip']} is done at {where}: another drone is at its place ({event['drone']})"
    )


def _failed(event: Event) -> str:
    return f"trip {event['trip']} failed ({event['drone']}): {event['reason']}"


def _extended(event: Event) -> str:
    told = [
        f"{what}: {', '.join(str(trip) for trip in trips)}"
        for what, trips in (("again", event.get("redo")), ("new", event.get("add")))
        if isinstance(trips, list) and trips
    ]
    return f"goes on with more trips ({'; '.join(told)})"


def _replanned(event: Event) -> str:
    todo: Any = event["todo"]
    trips = ", ".join(str(trip["name"]) for trip in todo) or "none"
    return f"was changed by a person; trips to do: {trips}"


def _ended(event: Event) -> str:
    reason = event.get("reason")
    return f"{event['status']}: {reason}" if reason else str(event["status"])


def _brought_back(event: Event) -> str:
    said = "was lost, and a person has looked after it" if event.get("lost") else "is back"
    return f"{event['drone']} {said}"


def _lost(event: Event) -> str:
    reason = event.get("reason")
    return f"{event['drone']} is lost" + (f": {reason}" if reason else "")


def _at(event: Event) -> str:
    at: Any = event["at"]
    return place(at)


def _waits(event: Event) -> str:
    said = str(event["reason"])
    if "until" in event:
        rest = float(str(event["until"])) - float(str(event["t"]))
        said += f", until {event['hour']} ({duration(max(0.0, rest))} more)"
    names: Any = event.get("missions", ())
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{', '.join(names[:_NAMED])}{more}: {said}" if names else said


def _clock_moved(event: Event) -> str | None:
    by = float(str(event["by"]))
    how = f"{duration(abs(by))} {'ahead' if by > 0.0 else 'back'}"
    said = f"the computer's clock is {how}, as it was set, or the computer slept: all hours count by it"
    return said if abs(by) >= 1.0 else None


_NAMED = 50
"""The most missions that one line names."""

_HOW = {"rtl": "all fly home", "land": "all land"}

_SENTENCES: Mapping[str, Callable[[Event], str | None]] = {
    "trip.launched": _launched,
    "trip.completed": _completed,
    ACTS_BESIDE: _beside,
    "trip.failed": _failed,
    "mission.late": lambda _: "is late: its deadline has passed",
    "mission.repeated": lambda event: f"round {int(str(event['round'])) + 1} begins",
    "mission.extended": _extended,
    "mission.replanned": _replanned,
    "mission.ended": _ended,
    "mission.paused": lambda _: "paused",
    "mission.resumed": lambda _: "goes on",
    "mission.uncertain": lambda event: f"waits for a person: {event['reason']}",
    "mission.held": lambda event: f"is held until a person decides: {event['reason']}",
    "mission.decided": lambda event: f"a person has decided: {event['answer']}",
    "trip.interrupted": lambda event: f"trip {event['trip']} interrupted; it will be flown again",
    "trip.skipped": lambda event: f"trip {event['trip']} skipped",
    "trip.prioritised": lambda event: f"trip {event['trip']} has priority {event['priority']}",
    "drone.joined": lambda event: f"{event['drone']} joins the fleet",
    "drone.mishap": lambda event: f"{event['drone']}: a mishap is rehearsed: {event['kind']}",
    "mission.waits": _waits,
    "drone.waits": lambda event: f"{event['drone']} {_waits(event)}",
    "drone.landed": lambda event: f"{event['drone']} has landed at {_at(event)}, where nobody asked it to",
    "drone.retired": lambda event: f"{event['drone']} is retired",
    "drone.brought_back": _brought_back,
    "drone.drained": lambda event: (
        f"{event['drone']} came home with {percent(float(str(event['level'])))} of its battery, less than its reserve"
    ),
    "drone.not_ready": lambda event: f"{event['drone']} is not ready: {event['reason']}",
    "stopped": lambda event: f"everything stops ({_HOW.get(str(event['how']), event['how'])})",
    "drone.recovering": lambda event: f"{event['drone']} recovers",
    "drone.lost": _lost,
    "clock.moved": _clock_moved,
    "log": lambda event: str(event["text"]),
}


Fact = Mapping[str, Any]


def journal_sentence(event: Fact, wall: float) -> str | None:
    """Return an event's sentence; for an event that has none, its plain facts.

    None: it is a measurement, which only programs read.
    """
    try:
        if event["event"] == "journal.begun":
            return _begun(event, wall)
        say = _JOURNAL_SENTENCES.get(event["event"])
        if say is None:
            line = line_of(event)
            return line if line is not None else _plain(event)
        mission = event.get("mission")
        said = say(event)
        if said is None:
            return None
        text = f"{mission}: {said}" if mission else said
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


def _promised(event: Fact) -> str:
    after = ", ".join(str(name) for name in event.get("after", ()))
    told = [f"begins after {after}"] if after else []
    when = {name: duration(event[name]) for name in ("opens", "deadline") if name in event}
    when |= event.get("hours", {})
    told += [f"begins at {when['opens']} at the soonest"] if "opens" in when else []
    told += [f"is due at {when['deadline']}"] if "deadline" in when else []
    return ", ".join(told)


def _changed(event: Fact) -> str:
    put = [str(trip["name"]) for trip in event["put"]]
    gone = [str(name) for name in event["gone"] if name not in put]
    told = [f"trips set or moved: {', '.join(put)}"] if put else []
    told += [f"trips taken away: {', '.join(gone)}"] if gone else []
    return "; ".join(["was changed by the app's own code", *told])


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


_JOURNAL_SENTENCES: Mapping[str, Callable[[Fact], str | None]] = {
    "brain.began": lambda event: "the app begins" if event["epoch"] == 1 else "the app goes on",
    "mission.created": _created,
    "mission.promised": _promised,
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
    FLEW: lambda _: None,
}
