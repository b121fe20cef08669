"""What must be true of every run of every app, whatever goes wrong: read off its trace.

Each invariant is a function of the events (see `plutoc_runtime/trace.py`) that yields a sentence for
each violation; `violations` asks all of them. Nothing here knows how the runtime works inside.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence

Event = Mapping[str, object]
Trace = Sequence[Event]

ENDS = ("COMPLETED", "FAILED")
TRIP_ENDS = ("trip.completed", "trip.failed")
UNWELL = ("drone.recovering", "drone.lost", "drone.charging", "drone.offline")


Items = Mapping[str, Mapping[str, str]]
"""By mission: the trips that pick an item, each with the trip that releases it."""


def violations(trace: Trace, items: Items) -> list[str]:
    """Return what is wrong with a whole run, from the first mission's creation to the last's end."""
    found = [sentence for invariant in INVARIANTS for sentence in invariant(trace)]
    return [*found, *items_stay_aboard(trace, items)]


def time_never_runs_backwards(trace: Trace) -> Iterator[str]:
    """Events stand in the order of their times."""
    last = 0.0
    for event in trace:
        now = _time(event)
        if now < last:
            yield f"{_at(event)}: {event['event']} comes after something at {last:g} s"
        last = now


def missions_end_once(trace: Trace) -> Iterator[str]:
    """Every mission ends, once, COMPLETED or FAILED, and who has FAILED says why."""
    ended = Counter(_text(event, "mission") for event in trace if _is(event, "mission.ended"))
    for event in trace:
        mission = _text(event, "mission")
        if _is(event, "mission.created") and ended[mission] != 1:
            yield f"{mission} ended {ended[mission]} times"
        if not _is(event, "mission.ended"):
            continue
        status, reason = _text(event, "status"), _text(event, "reason")
        if status not in ENDS:
            yield f"{_at(event)}: {mission} ended {status}"
        if status == "FAILED" and not reason.strip():
            yield f"{_at(event)}: {mission} failed without a reason"
        if status == "COMPLETED" and reason:
            yield f"{_at(event)}: {mission} was completed, yet says why it failed: {reason}"


def nothing_happens_after_the_end(trace: Trace) -> Iterator[str]:
    """A mission that has ended does nothing any more."""
    over: set[str] = set()
    for event in trace:
        mission = _text(event, "mission")
        if mission in over and not _is(event, "log"):
            yield f"{_at(event)}: {mission} had ended before {event['event']}"
        if _is(event, "mission.ended"):
            over.add(mission)


def trips_do_not_overlap(trace: Trace) -> Iterator[str]:
    """A mission has one trip in flight at a time, and what ends is what was launched."""
    flying: dict[str, tuple[object, ...]] = {}
    for event in trace:
        mission = _text(event, "mission")
        if _is(event, "trip.launched"):
            if mission in flying:
                yield f"{_at(event)}: {mission} launched {event['trip']} during {_who(flying[mission])}"
            flying[mission] = _flight(event)
        elif _is(event, *TRIP_ENDS):
            launched = flying.pop(mission, None)
            if launched is None:
                yield f"{_at(event)}: {event['trip']} of {mission} ended and was not in flight"
            elif launched != _flight(event):
                yield f"{_at(event)}: {_who(_flight(event))} of {mission} ended, not {_who(launched)}"
        elif _is(event, "mission.ended") and mission in flying:
            yield f"{_at(event)}: {mission} ended during {_who(flying[mission])}"


def drones_serve_one_mission_at_a_time(trace: Trace) -> Iterator[str]:
    """A drone gets a second trip only after its first ended and it was free again.

    A mission may be given again the drone that it holds: it was not launched yet, or has its item.
    """
    holder: dict[str, str] = {}
    away: set[str] = set()
    for event in trace:
        drone, mission = _text(event, "drone"), _text(event, "mission")
        if _is(event, "drone.free"):
            holder.pop(drone, None)
            away.discard(drone)
        elif _is(event, "drone.returning", *UNWELL):
            holder.pop(drone, None)
            away.add(drone)
        elif _is(event, "trip.allocated"):
            if drone in away:
                yield f"{_at(event)}: {drone} was given to {mission} before it was free again"
            elif holder.get(drone, mission) != mission:
                yield f"{_at(event)}: {drone} was given to {mission} while {holder[drone]} had it"
            holder[drone] = mission
        elif _is(event, "trip.launched") and holder.get(drone) != mission:
            yield f"{_at(event)}: {drone} flew for {mission}, which did not have it"


def unwell_drones_stay_down(trace: Trace) -> Iterator[str]:
    """No drone that recovers, charges or is lost is given to a mission; a lost one stays lost."""
    state: dict[str, str] = {}
    for event in trace:
        drone = _text(event, "drone")
        if _is(event, "trip.allocated", "trip.launched") and state.get(drone) in UNWELL:
            yield f"{_at(event)}: {event['event']} with {drone} after {state[drone]}"
        if str(event["event"]).startswith("drone."):
            if state.get(drone) == "drone.lost":
                yield f"{_at(event)}: {drone} was lost before {event['event']}"
            state[drone] = str(event["event"])


def attempts_count_up(trace: Trace) -> Iterator[str]:
    """The flights of one trip in one round are numbered 1, 2, 3."""
    last: Counter[tuple[object, ...]] = Counter()
    for event in trace:
        if _is(event, "trip.launched"):
            trip = (event["mission"], event["trip"], event["round"])
            last[trip] += 1
            if event["attempt"] != last[trip]:
                yield (
                    f"{_at(event)}: flight {last[trip]} of {event['trip']} of {event['mission']} "
                    f"calls itself attempt {event['attempt']}"
                )


def completed_missions_did_everything(trace: Trace) -> Iterator[str]:
    """Who ends COMPLETED has completed every trip of its last round, added ones included."""
    own: dict[str, list[str]] = {}
    to_do: dict[str, Counter[str]] = {}
    for event in trace:
        mission = _text(event, "mission")
        if _is(event, "mission.created"):
            own[mission] = _names(event, "trips")
            to_do[mission] = Counter(own[mission])
        elif _is(event, "mission.extended"):
            to_do[mission].update(_names(event, "redo") + _names(event, "add"))
        elif _is(event, "mission.repeated"):
            to_do[mission] = Counter(own[mission])
        elif _is(event, "trip.completed"):
            to_do[mission][_text(event, "trip")] -= 1
        elif _is(event, "mission.ended") and event["status"] == "COMPLETED":
            for trip, times in to_do[mission].items():
                if times:
                    yield f"{_at(event)}: {mission} ended COMPLETED, {trip} {times} times to do"


def items_stay_aboard(trace: Trace, items: Items) -> Iterator[str]:
    """From pick to release a mission's item stays with one drone, and that drone with it."""
    carrier: dict[str, tuple[str, str]] = {}
    for event in trace:
        mission, trip, drone = (_text(event, key) for key in ("mission", "trip", "drone"))
        release_of = items.get(mission, {})
        if _is(event, "trip.completed") and trip in release_of:
            carrier[mission] = drone, release_of[trip]
        elif _is(event, "trip.allocated", "trip.launched"):
            has = carrier.get(mission)
            if has is not None and has[0] != drone:
                yield f"{_at(event)}: {mission} has its item aboard {has[0]}, yet takes {drone}"
            for other, (carries, _) in carrier.items():
                if carries == drone and other != mission:
                    yield f"{_at(event)}: {drone} has the item of {other}, yet serves {mission}"
        elif _is(event, "trip.completed") and mission in carrier and trip == carrier[mission][1]:
            del carrier[mission]
        elif _is(event, "trip.failed", "mission.ended"):
            carrier.pop(mission, None)


INVARIANTS: tuple[Callable[[Trace], Iterator[str]], ...] = (
    time_never_runs_backwards,
    missions_end_once,
    nothing_happens_after_the_end,
    trips_do_not_overlap,
    drones_serve_one_mission_at_a_time,
    unwell_drones_stay_down,
    attempts_count_up,
    completed_missions_did_everything,
)
"""Those that need the trace alone."""


def _is(event: Event, *kinds: str) -> bool:
    return event["event"] in kinds


def _time(event: Event) -> float:
    return float(str(event["t"]))


def _at(event: Event) -> str:
    return f"{_time(event):g} s"


def _text(event: Event, key: str) -> str:
    """A fact, or nothing: not every event has a mission or a drone."""
    value = event.get(key)
    return "" if value is None else str(value)


def _names(event: Event, key: str) -> list[str]:
    value = event[key]
    assert isinstance(value, list)
    return [str(name) for name in value]


def _flight(event: Event) -> tuple[object, ...]:
    return (event["trip"], event["drone"], event["round"], event["attempt"])


def _who(flight: tuple[object, ...]) -> str:
    trip, drone, round_, attempt = flight
    return f"{trip} ({drone}, round {round_}, attempt {attempt})"
