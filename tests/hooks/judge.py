"""What must not be in the run of an app, whatever its hooks do."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.trials.invariants import Invariants
from pluto_fleet.trials.rules import (
    AttemptsCountUp,
    EventsHappenOnce,
    NothingAfterTheEnd,
    TripsDoNotOverlap,
)

RULES = (AttemptsCountUp, EventsHappenOnce, NothingAfterTheEnd, TripsDoNotOverlap)
ROUNDED = 1e-6
"""Seconds to which an event has its time."""
FLOWN = ("trip.completed", "trip.failed", "trip.interrupted")


def wrong(events: Sequence[Event]) -> list[str]:
    """Return what must not be in a run: two flights of one id, or two completions."""
    invariants = Invariants({}, RULES)
    for event in events:
        invariants.take(event)
    done = Counter(
        tuple(str(event[fact]) for fact in ("mission", "trip", "round", "attempt"))
        for event in events
        if event["event"] == "trip.completed"
    )
    return invariants.found + [f"completed {n} times: {of}" for of, n in done.items() if n > 1]


def outlived(looked: Mapping[str, Sequence[float]], events: Sequence[Event]) -> Iterator[str]:
    """Yield which actions on the way went on although no trip of this name was in flight."""
    flown: dict[object, list[list[float]]] = {}
    under_way: dict[object, list[float]] = {}
    for event in events:
        mission = event.get("mission")
        if event["event"] == "trip.launched":
            under_way[mission] = [event["t"]]
            flown.setdefault(event["trip"], []).append(under_way[mission])
        elif event["event"] in (*FLOWN, "mission.ended") and mission in under_way:
            under_way.pop(mission).append(event["t"])
    for trip, times in looked.items():
        for time in times:
            if not any(
                begun <= time <= (*end, time)[0] + ROUNDED for begun, *end in flown.get(trip, ())
            ):
                yield f"{trip} looked at {time:g} s, and has flown {flown.get(trip)}"


def hanging(events: Sequence[Event], until: float) -> Iterator[str]:
    """Yield which missions have not ended, and have not flown for half of the time."""
    launched: dict[str, float] = {}
    for event in events:
        match event:
            case {"event": "mission.created", "mission": mission}:
                launched.setdefault(mission, 0.0)
            case {"event": "trip.launched", "mission": mission, "t": when}:
                launched[mission] = when
            case {"event": "mission.ended" | "mission.uncertain", "mission": mission}:
                launched[mission] = until  # or a person is asked
    yield from (f"{one} hangs" for one, when in launched.items() if when < until / 2)


def ended_as(mission: object, events: Sequence[Event]) -> tuple[str, str]:
    """Return the status with which a mission ended, and why; empty: it has not."""
    for event in events:
        if event["event"] == "mission.ended" and event["mission"] == mission:
            return event["status"], event["reason"]
    return "", ""


def broken_off(events: Sequence[Event]) -> set[object]:
    """Return the missions of which an event broke a flight off."""
    off = (event for event in events if event["event"] == "trip.interrupted" and "by" in event)
    return {event["mission"] for event in off}
