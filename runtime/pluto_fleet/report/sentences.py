"""The events of a flight as sentences, one for each."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..jobs.flown import ACTS_BESIDE, FLEW
from ..shared.domain.text import duration, number, percent, place, printable, shown

if TYPE_CHECKING:
    from ..shared.domain.trace import Event


Fact = Mapping[str, Any]

Say = str | Callable[[Fact], str | None]
"""A sentence with the names of an event's facts, or what returns one."""


def line_of(event: Event) -> str | None:
    """Return the line for an event; None for one that is of no interest to people."""
    said = sentence_of(event)
    if said is None:
        return None
    time = f"{float(event['t']):>8.1f} s  "
    mission = event.get("mission")
    text = f"{mission}: {said}" if mission else said
    first, *rest = text.split("\n")  # a hook's traceback has many lines
    return "\n".join([time + printable(first), *(" " * len(time) + printable(r) for r in rest)])


def sentence_of(event: Event) -> str | None:
    """Return an event's sentence, without time and mission; None: it is of no interest to people."""
    say = _SENTENCES.get(str(event["event"]))
    return None if say is None else _said(say, event)


def _said(say: Say, event: Mapping[str, Any]) -> str | None:
    return say.format_map(event) if isinstance(say, str) else say(event)


def _launched(event: Fact) -> str:
    again = ", again" if event.get("attempt", 1) != 1 else ""
    return f"trip {event['trip']} launched{again} ({event['drone']})"


def _beside(event: Fact) -> str:
    where = f"{place(event['at'])} at a height of {number(event['at'][2])} m"
    return f"trip {event['trip']} is done by {event['drone']} at {where}: another drone is at its place"


def _extended(event: Fact) -> str:
    told = [
        f"{what}: {', '.join(str(trip) for trip in trips)}"
        for what, trips in (("again", event.get("redo")), ("new", event.get("add")))
        if isinstance(trips, list) and trips
    ]
    return f"goes on with more trips ({'; '.join(told)})"


def _replanned(event: Fact) -> str:
    trips = ", ".join(trip["name"] for trip in event["todo"]) or "none"
    return f"was changed by a person; trips to do: {trips}"


def _ended(event: Fact) -> str:
    reason = event.get("reason")
    return f"{event['status']}: {reason}" if reason else str(event["status"])


def _brought_back(event: Fact) -> str:
    said = "was lost, and a person has looked after it" if event.get("lost") else "is back"
    return f"{event['drone']} {said}"


def _lost(event: Fact) -> str:
    reason = event.get("reason")
    return f"{event['drone']} is lost" + (f": {reason}" if reason else "")


def _waits(event: Fact) -> str:
    said = str(event["reason"])
    if "until" in event:
        rest = float(event["until"]) - float(event["t"])
        said += f", until {event['hour']} ({duration(max(0.0, rest))} more)"
    names = event.get("missions", ())
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{', '.join(names[:_NAMED])}{more}: {said}" if names else said


def _clock_moved(event: Fact) -> str | None:
    by = float(event["by"])
    how = f"{duration(abs(by))} {'ahead' if by > 0.0 else 'back'}"
    said = f"the computer's clock is {how}, as it was set, or the computer slept: all hours count by it"
    return said if abs(by) >= 1.0 else None


def _raised(event: Fact) -> str:
    at = event.get("at")
    where = f" at {place(at)}" if at else ""
    what = f", track {event['track']}" if event.get("track") else ""
    fields = "".join(f", {name} {shown(one)}" for name, one in event.get("fields", {}).items())
    return f"event {event['kind']} happens{where}{what}{fields} ({event['id']})"


def _interrupted(event: Fact) -> str:
    by = f" by event {event['by']}" if event.get("by") else ""
    return f"trip {event['trip']} interrupted{by}; it will be flown again"


def _over(event: Fact) -> str:
    made = event.get("made")
    came = f"mission {made} begins" if made else f"no mission: {event.get('why')}"
    return f"event {event['id']}: {came}"


_NAMED = 50
"""The most missions that one line names."""

_HOW = {"rtl": "all fly home", "land": "all land"}

_SENTENCES: Mapping[str, Say] = {
    "trip.launched": _launched,
    "trip.completed": "trip {trip} completed ({drone})",
    ACTS_BESIDE: _beside,
    "trip.failed": "trip {trip} failed ({drone}): {reason}",
    "mission.late": "is late: its deadline has passed",
    "mission.repeated": lambda event: f"round {int(event['round']) + 1} begins",
    "mission.extended": _extended,
    "mission.replanned": _replanned,
    "mission.ended": _ended,
    "mission.paused": "paused",
    "mission.resumed": "goes on",
    "mission.uncertain": "waits for a person: {reason}",
    "mission.held": "is held until a person decides: {reason}",
    "mission.decided": "a person has decided: {answer}",
    "trip.interrupted": _interrupted,
    "trip.skipped": "trip {trip} skipped",
    "trip.relieving": "{drone} sets out to relieve the drone of trip {trip}",
    "trip.handed_over": "{drone} takes over trip {trip} from {of}",
    "action.result": "trip {trip}: a result on the way ({drone})",
    "event.raised": _raised,
    "event.over": _over,
    "event.kept": lambda event: (
        f"event {event['kind']} is kept for {duration(event['keep'])} ({event['id']})"
    ),
    "event.dropped": "event {kind} is dropped: {why} ({id})",
    "trip.prioritised": "trip {trip} has priority {priority}",
    "drone.joined": "{drone} joins the fleet",
    "drone.mishap": "{drone}: a mishap is rehearsed: {kind}",
    "mission.waits": _waits,
    "drone.waits": lambda event: f"{event['drone']} {_waits(event)}",
    "drone.landed": lambda event: (
        f"{event['drone']} has landed at {place(event['at'])}, where nobody asked it to"
    ),
    "drone.retired": "{drone} is retired",
    "drone.brought_back": _brought_back,
    "drone.drained": lambda event: (
        f"{event['drone']} came home with {percent(float(event['level']))} of its battery, less than its reserve"
    ),
    "drone.not_ready": "{drone} is not ready: {reason}",
    "stopped": lambda event: f"everything stops ({_HOW.get(str(event['how']), event['how'])})",
    "drone.recovering": "{drone} recovers",
    "drone.lost": _lost,
    "clock.moved": _clock_moved,
    "log": lambda event: str(event["text"]),
    "said": lambda event: str(event["text"]),
}


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
        said = _said(say, event)
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


def _delayed(event: Fact) -> str:
    rest = float(event["until"]) - float(event["t"])
    return f"trip {event['trip']} waits {duration(max(rest, 0.0))}"


def _modified(event: Fact) -> str:
    why = f": {event['reason']}" if event.get("reason") else ""
    return f"a modifier makes it {event['status']}{why}"


_JOURNAL_SENTENCES: Mapping[str, Say] = {
    "brain.began": lambda event: "the app begins" if event["epoch"] == 1 else "the app goes on",
    "mission.created": lambda event: f"has trips {', '.join(map(str, event['trips']))}",
    "mission.promised": _promised,
    "mission.changed": _changed,
    "mission.modified": _modified,
    "mission.judged": "was judged and found wanting: {reason}",
    "trip.allocated": "trip {trip} gets {drone}: {why}",
    "trip.delayed": _delayed,
    "trip.reset": "trip {trip} waits for attempt {attempt}",
    "action.begun": "the action of trip {trip} begins ({drone})",
    "drone.free": "{drone} is free",
    "drone.offered": "{drone} hovers, and any trip may have it",
    "drone.busy": "{drone} stays with its mission",
    "drone.returning": "{drone} returns home",
    "drone.charging": "{drone} charges",
    "drone.offline": "{drone} does not answer",
    FLEW: lambda _: None,
    "shown": lambda _: None,
}
