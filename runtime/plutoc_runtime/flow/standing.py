"""Missions and drones as plain data: what begins, where each stands, and for what it waits.

And in which block a mission waits, or an error arose: `flow.py` quotes a block's declaration above
each call of it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from dataclasses import fields as dataclass_fields
from typing import TYPE_CHECKING, Any

from ..domain.fields import Entity
from ..domain.keeper import plain_again, put, put_trips, trips_of
from ..domain.status import Status, TripStatus
from ..domain.text import said
from ..hooks.plain_data import fields_of, item_data, known_fields, trip_data, trip_of
from .promises import moment_of

if TYPE_CHECKING:
    from types import CodeType, FrameType

    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Drone, Mission, Trip
    from ..fleet.fleet import Fleet
    from ..hooks.plain_data import Data
    from ..trips.flight import Flight
    from .mission import MissionState


def mission_of(app: App, data: Mapping[str, Any], index: int) -> Mission[Any]:
    """Return a new mission; what the app does not know is left out."""
    trips = [trip_of(app, one, place) for place, one in enumerate(data["trips"])]
    index, fields = data.get("index", index), known_fields(app, Entity.MISSION, data)
    name, promises = data.get("name", f"{index + 1}"), data.get("promises", {})
    return app.mission(name=name, trips=trips, index=index, promises=promises, **fields)


def standing_of(app: App, state: MissionState) -> Data:
    """Return where a mission stands."""
    mission, flight = state.mission, state.flight
    return {
        "index": mission.index,
        "fields": fields_of(app, Entity.MISSION, mission),
        "status": mission.status.value,
        "reason": mission.reason,
        "round": mission.round,
        "attempts": mission.attempts,
        "todo": [_trip(app, trip) for trip in trips_of(mission)],
        "done": [_trip(app, trip) for trip in mission.completed_trips],
        "at": state.at,
        "delay": state.delay and [list(state.delay[0]), state.delay[1], state.delay[2]],
        "waited": sorted(map(list, state.waited or ())),
        "first_start": state.first_start,
        "last_action_end": state.last_action_end,
        "flight": flight and _flight(flight),
        "carrier": None if state.carrier is None else state.carrier.id,
        "carries": item_data(state.carries),
        "interrupted": state.interrupted,
        "ended": state.ended,
        **(
            {"promises": plain_again(mission.promises), "late": mission.late}
            if mission.promises
            else {}
        ),
    }


def _flight(flight: Flight) -> Data:
    return {
        "trip": flight.trip.name,
        "drone": flight.drone,
        "since": flight.launched_at,
        "retry": flight.retry,
        "outcome": flight.result().value if flight.is_set else None,
    }


def _trip(app: App, trip: Trip) -> Data:
    flown = {"start_time": trip.start_time, "end_time": trip.end_time}
    facts = {"reason": trip.reason or None, **flown}
    return trip_data(app, trip) | {name: one for name, one in facts.items() if one is not None}


def whereabouts_of(state: MissionState, flow: Callable[..., Any]) -> Data:
    """Return where a mission is in its graph, which drone it has, and until when it is delayed."""
    flight, drone = state.in_flight, state.allocated or state.carrier
    if state.allocated is None and flight is not None:
        drone = flight.flier
    return {
        "lives": state.task is not None,
        "block": "" if state.task is None else waiting_at(state.task.coroutine, flow),
        "drone": drone and drone.id,
        "flies": flight is not None,
        "allocated": state.allocated is not None,
        "until": state.held_until,
        "opens": moment_of(state.mission, "opens", state.core.kernel.drift),
        "deadline": state.mission.deadline,
    }


def drone_standing(drone: Drone, fleet: Fleet, aside: bool) -> Data:
    """Return where a drone stands, what it has flown, and why it is not ready to fly, as `unready`."""
    return {
        "aside": aside,
        **({"ready_at": fleet.queue.ready_at(drone)} if aside else {}),
        "unready": fleet.unready.get(drone, ""),
        "retired": drone in fleet.retired,
        "low": fleet.is_low(drone),
        "status": drone.status.value,
        "at": list(drone.location),
        "battery": drone.battery_level,
        "landed": drone.telemetry.landed,
        "trips": drone.trips,
    }


def update(app: App, mission: Mission[Any], record: Mapping[str, Any]) -> dict[str, Trip]:
    """Bring a mission up to date with its record; return all its trips by name, also those dropped."""
    trips = {trip.name: trip for trip in (*trips_of(mission), *mission.completed_trips)}
    lists: dict[str, list[Trip]] = {}
    for which, status in _LISTS.items():
        lists[which] = []
        for data in record.get(which, ()):
            now = trip_of(app, data, status=status)
            trip = trips.setdefault(now.name, now)
            put(trip, **{one.name: getattr(now, one.name) for one in dataclass_fields(now)})
            lists[which].append(trip)
    put_trips(mission, lists["todo"])
    put(
        mission,
        completed_trips=tuple(lists["done"]),
        status=Status(record["status"]),
        reason=record.get("reason", ""),
        round=record.get("round", 0),
        attempts=record.get("attempts", 0),
        promises=record.get("promises", {}),
        late=bool(record.get("late")),
        **record.get("fields", {}),
    )
    return trips


_LISTS = {"gone": TripStatus.SKIPPED, "done": TripStatus.COMPLETED, "todo": TripStatus.WAITING}
"""The lists of a record, and the usual status of the trips in them."""


def fleet_data(fleet: FleetData) -> Data:
    """Return what a brain needs to know of a fleet."""
    drones = [{"id": one.id, "category": one.category, "home": one.home} for one in fleet.drones]
    return {
        "drones": drones,
        "after_trip": fleet.after_trip.value,
        "max_airborne": fleet.max_airborne,
        "charges_at_home": fleet.charges_at_home,
        "motion": asdict(fleet.motion),
        "began": fleet.began,
        "zone": fleet.zone,
    }


# Where in the graph


def blame(error: BaseException, flow: Callable[..., Any]) -> None:
    """Add to an error that escapes from a flow in which block it arose: `in block watch = TripMonitor`."""
    block = blamed(error, flow)
    if block:
        error.add_note(f"in block {block}")


def as_crash(error: BaseException) -> Exception:
    """Return an error that ends the app as a bug: a block's `SystemExit` would pass for a normal end."""
    if isinstance(error, Exception):
        return error
    return RuntimeError(f"it raised {said(error)}").with_traceback(error.__traceback__)


def traced(error: BaseException) -> str:
    """Return where an error arose, and what it says, for the log."""
    from traceback import format_tb  # only where something has gone wrong

    return "".join(format_tb(error.__traceback__)) + said(error)


def blamed(error: BaseException, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block in which an error arose; empty if it was in none.

    Of a fork and its gate it is what stands in their place: `launch -> [a, b] -> first = GateFIFO`.
    """
    from traceback import walk_tb  # only where something has gone wrong

    code, found = getattr(flow, "__code__", None), ""
    for frame, line in walk_tb(error.__traceback__):
        if code is not None and frame.f_code.co_filename == code.co_filename:
            found = declaration_above(frame, line) or found
    return found


def declaration_above(frame: FrameType, line: int) -> str:
    """Return the nearest comment above a line of a function that is not within an arm before it."""
    import linecache

    margin = None
    for number in range(line, frame.f_code.co_firstlineno, -1):
        text = linecache.getline(frame.f_code.co_filename, number, frame.f_globals)
        indent = len(text) - len(text.lstrip())
        if not text.strip() or (margin is not None and indent > margin):
            continue
        margin = indent
        if text.lstrip().startswith("# "):
            return text.strip().removeprefix("# ")
    return ""


_KNOWN: dict[tuple[CodeType, int], str] = {}  # a cache of comments, by the line below them


def waiting_at(coroutine: object, flow: Callable[..., Any]) -> str:
    """Return the declaration of the block at which a mission's coroutine waits, or nothing.

    It is found by the suspended frames, so that observing a flight costs it nothing.
    """
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
