"""The rows of missions and drones for pages, and the blocks at which a mission waits."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from math import isfinite
from types import CodeType, FrameType
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status, TripStatus
from plutoc_runtime.domain.text import cut_off
from plutoc_runtime.flow.control import PRIORITY
from plutoc_runtime.flow.location import declaration_above

from ..flight.control import ANSWERS
from ..flight.mission_status import aside
from ..gateway.wire import STALE_AFTER

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission, Point, Trip
    from plutoc_runtime.flow.mission import MissionState

    from ..gateway.sightings import Sighting
    from ..journal.fold import Record

END = "end"
"""The pseudo-block of missions that have ended."""

ENDED = (Status.COMPLETED, Status.FAILED, Status.CANCELLED)

_BRANCHES = re.compile(r"\[(.*)\]")
_WORD = re.compile(r"\w+")


def blocks_of(state: MissionState, flow: Callable[..., Any]) -> tuple[str, ...]:
    """Return the blocks at which a running mission waits: several within a fork.

    They are found by its suspended coroutine, below a comment that quotes the block's declaration, so
    that observing a flight costs it nothing.
    """
    if state.task is None:
        return (state.at,) if state.at is not None else ()
    return _named(_waiting_at(state.task.coroutine, flow))


_KNOWN: dict[tuple[CodeType, int], str] = {}
"""A cache of comments, by the line below them."""


def _waiting_at(coroutine: object, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block at which a mission's coroutine waits, or nothing."""
    file, found = flow.__code__.co_filename, ""
    while coroutine is not None:
        frame: FrameType | None = getattr(coroutine, "cr_frame", None)
        if frame is not None and frame.f_code.co_filename == file:
            place = frame.f_code, frame.f_lineno
            if place not in _KNOWN:
                _KNOWN[place] = declaration_above(frame, frame.f_lineno)
            found = _KNOWN[place] or found
        coroutine = getattr(coroutine, "cr_await", None)
    return found


@cache
def _named(declaration: str) -> tuple[str, ...]:
    """Return the blocks' names: two for `launch -> [watch, timer] -> first = GateFIFO`, one for `wait = Clock`."""
    branches = _BRANCHES.search(declaration.partition("(")[0])
    if branches is not None:
        return tuple(word[0] for part in branches[1].split(",") if (word := _WORD.search(part)))
    word = _WORD.match(declaration)
    return (word[0],) if word is not None else ()


Row = dict[str, object]

LONGEST_REASON = 200
"""Characters of the reason why a drone may not fly; the full text is on the console."""


def mission_row(
    app: App,
    mission: Mission[Any],
    state: MissionState | None,
    now: float,
    fleet: Callable[[Trip], str],
) -> Row:
    """Return the row of a mission; `fleet` returns why no drone flies a trip yet."""
    done, todo = mission.completed_trips, mission.trips
    at = blocks_of(state, app.flow) if state is not None else ()
    status = mission.status
    ends = status in ENDED
    if ends and state is not None:  # its trips are done; a block has yet to decide
        status, ends = Status.STANDBY, False
    until = _until(state, now)
    current = todo[0] if todo else None
    drone = _drone_of(mission, state)
    return {
        "name": mission.name,
        "index": mission.index,
        "status": status.value,
        "reason": mission.reason,
        "trips": [_trip(trip) for trip in (*done, *todo)],
        "current": len(done) if todo else None,
        "done": len(done),
        "total": len(done) + len(todo),
        "drone": drone.id if drone is not None else None,
        "at": [END] if ends else list(at),
        "wait": "" if state is None else _why_it_waits(app, state, at, until, fleet),
        "until": until,
        "attempt": current.attempt if current is not None else 1,
        "attempts": mission.attempts,
        "round": mission.round,
        "question": _question(mission.status, mission.reason),
    }


def recorded_row(name: str, record: Record, *, lives: bool = False) -> Row:
    """Return the row of a mission from its journal's record; `lives`: its app is running."""
    done, todo = record["done"], record["todo"]
    status, reason = aside(record) or (Status(record["status"]), str(record["reason"]))
    if status is Status.RUNNING or (status in ENDED and not record["ended"]):
        status = Status.STANDBY  # it flew, and does so no longer; or its outcome is open
    at = [END] if record["ended"] else [record["at"]] if record["at"] else []
    return {
        "name": name,
        "index": record["index"],
        "status": status.value,
        "reason": reason,
        "trips": [_recorded_trip(trip, "COMPLETED") for trip in done]
        + [_recorded_trip(trip, "WAITING") for trip in todo],
        "current": len(done) if todo else None,
        "done": len(done),
        "total": len(done) + len(todo),
        "drone": record["carrier"] if lives else None,
        "at": at,
        "wait": _WAITS.get(status, "") if lives else "",
        "until": None,
        "attempt": todo[0].get("attempt", 1) if todo else 1,
        "attempts": record["attempts"],
        "round": record["round"],
        "question": _question(status, reason) if lives else None,
    }


def drone_row(
    drone: Drone,
    silence: float,
    mission: str | None,
    retired: bool,
    why: str = "",
    status: str = "",
) -> Row:
    """Return the row of a drone, rounded to centimetres and thousandths.

    `silence`: the seconds since it was heard last; `why`: why it may not fly; `status` replaces its
    own status if that would mislead.
    """
    heard = isfinite(silence)
    return _drone_row(
        drone.id,
        status or drone.status.value,
        drone.location if heard else None,
        drone.battery_level if heard else None,
        mission,
        drone.trips,
        retired,
        why,
        time.time() - silence if heard and silence > STALE_AFTER else None,
    )


def drone_at(
    id: str,
    status: str,
    seen: Sighting | None,
    trips: int,
    retired: bool,
    why: str,
) -> Row:
    """Return the row of a drone without a flight; `seen` is the time of its last known state."""
    if seen is None:
        return _drone_row(id, status, None, None, None, trips, retired, why)
    battery = seen.battery if seen.when else None
    return _drone_row(id, status, seen.at, battery, None, trips, retired, why, seen.when)


def mission_of_each(states: Iterable[MissionState]) -> dict[str, str]:
    """Return the mission of each drone, by name."""
    drones = ((_drone_of(state.mission, state), state.mission.name) for state in states)
    return {drone.id: name for drone, name in drones if drone is not None}


def _drone_row(
    id: str,
    status: str,
    at: Point | None,
    battery: float | None,
    mission: str | None,
    trips: int,
    retired: bool,
    why: str = "",
    when: float | None = None,
) -> Row:
    x, y, z = (None, None, None) if at is None else (round(metres, 2) for metres in at)
    return {
        "id": id,
        "status": status,
        "x": x,
        "y": y,
        "z": z,
        "seen": None if when is None else round(when) * 1000,
        "battery": None if battery is None else round(battery, 3),
        "mission": mission,
        "trips": trips,
        "retired": retired,
        "why": cut_off(why, LONGEST_REASON),
    }


def _trip(trip: Trip) -> list[object]:
    x, y, _ = trip.target
    priority = getattr(trip, PRIORITY, None)
    return [trip.name, trip.status.value, round(x, 3), round(y, 3), priority, trip.action]


def _recorded_trip(data: Record, status: str) -> list[object]:
    x, y, _ = data["target"]
    stands = data.get("status", status)
    if stands == TripStatus.EXECUTING.value:  # unknown until it has been queried
        stands = TripStatus.WAITING.value
    priority = data.get("fields", {}).get(PRIORITY)
    return [data["name"], stands, round(x, 3), round(y, 3), priority, data["action"]]


def _drone_of(mission: Mission[Any], state: MissionState | None) -> Drone | None:
    if state is None:
        return None
    flight = state.in_flight
    return state.allocated or (flight.flier if flight is not None else state.carrier)


def _until(state: MissionState | None, now: float) -> float | None:
    if state is None or state.delay is None:
        return None
    until = max(state.delay[1:])
    return until if until > now else None


def _why_it_waits(
    app: App,
    state: MissionState,
    at: Sequence[str],
    until: float | None,
    fleet: Callable[[Trip], str],
) -> str:
    mission = state.mission
    if state.in_flight is not None or state.task is None:
        return ""
    if until is not None:
        return "waits until its time has come"
    if state.allocated is None and at and at[0] in app.resumes:
        why = fleet(mission.current)
        return f"waits for a drone ({why})" if why else "waits for a drone"
    if at and mission.status in ENDED:
        return f"waits for what {at[0]} says"
    return ""


_WAITS = {Status.PAUSED: "paused", **dict.fromkeys(ANSWERS, "waits for your decision")}


def _question(status: Status, text: str) -> Row | None:
    answers = ANSWERS.get(status)
    return None if answers is None else {"text": text, "answers": list(answers)}
