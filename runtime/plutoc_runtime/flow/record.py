"""The record of a running app: its missions, trips, drones and results as rows of plain data, and back.

A row is all of one of these that survives the app. What hooks can see of it is a function of rows, so it is the
same after a restart as before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from dataclasses import fields as dataclass_fields
from typing import TYPE_CHECKING, Any

from ..domain.fields import Entity
from ..domain.keeper import keeper_of, plain_again, put, put_trips, trips_of
from ..domain.model import Result
from ..domain.status import Status, TripStatus
from ..hooks.plain_data import (
    fields_of,
    item_data,
    known_fields,
    point_of,
    trip_data,
    trip_of,
    value_data,
    value_of,
)
from .promises import moment_of

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Drone, Mission, ResultStore, Trip
    from ..fleet.fleet import Fleet
    from ..hooks.plain_data import Data
    from .changes import Changes
    from .flight import Flight
    from .mission import MissionState

Row = tuple[str, tuple[str | int, ...], Mapping[str, Any]]
"""Its table (`mission`, `trip`, `drone` or `result`), its key there, and what it holds."""


def changed_rows(
    app: App,
    changes: Changes,
    states: Mapping[str, MissionState],
    results: ResultStore,
    fleet: Fleet,
) -> list[Row]:
    """Return the rows that have changed since the last call."""
    changes.arrange()
    rows: list[Row] = [
        ("mission", (name,), mission_row(app, states[name])) for name in changes.missions
    ]
    for trip, name in changes.trips.items():
        rows.append(("trip", (name, trip.number), trip_row(app, trip, states[name].gone)))
    rows += [("drone", (drone.id,), drone_row(drone, fleet)) for drone in changes.drones]
    rows += [
        ("result", (number,), result_row(results.results[number]))
        for number in range(changes.results, len(results.results))
    ]
    changes.clear(len(results.results))
    return rows


# Missions


def mission_of(app: App, data: Mapping[str, Any], index: int) -> Mission[Any]:
    """Return a new mission; what the app does not know is left out."""
    trips = [trip_of(app, one, place) for place, one in enumerate(data["trips"])]
    index, fields = data.get("index", index), known_fields(app, Entity.MISSION, data)
    name, promises = data.get("name", f"{index + 1}"), data.get("promises", {})
    return app.mission(name=name, trips=trips, index=index, promises=promises, **fields)


def mission_row(app: App, state: MissionState) -> Data:
    """Return the row of a mission."""
    mission, flight = state.mission, state.flight
    keeper = keeper_of(mission)
    row: Data = {
        "index": mission.index,
        "fields": fields_of(app, Entity.MISSION, mission),
        "round": mission.round,
        "attempts": mission.attempts,
        "at": state.at,
        "delay": state.delay and [list(state.delay[0]), state.delay[1], state.delay[2]],
        "waited": sorted(map(list, state.waited or ())),
        "first_start": state.first_start,
        "last_action_end": state.last_action_end,
        "flight": flight and _flight(flight),
        "carrier": None if state.carrier is None else state.carrier.id,
        "carries": item_data(state.carries),
        "judged": state.judged,
        "interrupted": state.interrupted,
        "accepted": state.accepted,
        "promises": plain_again(mission.promises),
        "late": mission.late,
        "replanned": state.replanned,
        "changed": keeper is not None and keeper.changed,
    }
    if state.unfit is not None:
        row.update((fact, one) for fact, one in state.unfit.items() if fact not in _LISTS)
    row.update(
        status=mission.status.value,
        reason=mission.reason,
        ended=state.ended,
        paused=state.paused,
        question=state.question,
        held=state.held,
        answer=state.answer,
    )
    return row


def standing_of(app: App, state: MissionState) -> Data:
    """Return a mission's row with those of its trips: `todo` and `done` in order, and `gone`."""
    row = mission_row(app, state)
    if state.unfit is not None:
        row.update((which, state.unfit[which]) for which in _LISTS)
    else:
        gone = state.gone
        row["todo"] = [trip_row(app, trip, gone) for trip in trips_of(state.mission)]
        row["done"] = [trip_row(app, trip, gone) for trip in state.mission.completed_trips]
        row["gone"] = [trip_row(app, trip, gone) for trip in gone]
    return row


def _flight(flight: Flight) -> Data:
    return {
        "trip": flight.trip.name,
        "drone": flight.drone,
        "round": flight.round,
        "attempt": flight.attempt,
        "since": flight.launched_at,
        "retry": flight.retry,
        "begun": flight.begun,
        "beside": flight.beside,
        "outcome": flight.result().value if flight.is_set else None,
        "heard": flight.heard,
    }


def trip_row(app: App, trip: Trip, gone: Mapping[Trip, int]) -> Data:
    """Return the row of a trip, without the values that every new trip has."""
    row = trip_data(app, trip)
    if trip.number:
        row["number"] = trip.number
        row["rank"] = trip.rank
    if trip.drone is not None:
        row["drone"] = trip.drone.id
    if trip.start_time is not None:
        row["start_time"] = trip.start_time
    if trip.end_time is not None:
        row["end_time"] = trip.end_time
    if trip.reason:
        row["reason"] = trip.reason
    if trip in gone:
        row["round"] = gone[trip]
    return row


def result_row(result: Result[Any, Any]) -> Data:
    """Return the row of a result."""
    trip = result.trip
    return {
        "mission": result.mission.name,
        "trip": trip and trip.name,
        "number": trip and trip.number,
        "round": result.round,
        "attempt": result.attempt,
        "value": value_data(result.value),
        "time": result.time,
        "place": result.place,
    }


def result_of(row: Mapping[str, Any], mission: Mission[Any], trip: Trip | None) -> Result[Any, Any]:
    """Return a stored result."""
    place = row.get("place")
    return Result(
        mission,
        trip,
        row["round"],
        row["attempt"],
        value_of(row["value"]),
        row.get("time", 0.0),
        None if place is None else point_of(place),
    )


def update(
    app: App,
    mission: Mission[Any],
    record: Mapping[str, Any],
    drone: Callable[[str], Drone | None] | None = None,
) -> dict[Trip, int]:
    """Bring a mission up to date with its record; return the trips that it has no more, with their rounds.

    `drone` returns the drone of a name.
    """
    trips = {trip.name: trip for trip in (*trips_of(mission), *mission.completed_trips)}
    lists: dict[str, list[Trip]] = {}
    gone: dict[Trip, int] = {}
    for which, status in _LISTS.items():
        lists[which] = []
        for data in record.get(which, ()):
            now = trip_of(app, data, status=status)
            trip = now if which == "gone" else trips.setdefault(now.name, now)
            put(trip, **{one.name: getattr(now, one.name) for one in dataclass_fields(now)})
            put(trip, number=data.get("number", 0), rank=data.get("rank", 0))
            if drone is not None and "drone" in data:
                put(trip, drone=drone(data["drone"]))
            lists[which].append(trip)
            if which == "gone":
                gone[trip] = data.get("round", 0)
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
    return gone


_LISTS = {"gone": TripStatus.SKIPPED, "done": TripStatus.COMPLETED, "todo": TripStatus.WAITING}
"""The lists of a record, and the usual status of the trips in them."""


def whereabouts_of(state: MissionState, block: str) -> Data:
    """Return where a mission is in its graph, which drone it has, and until when it is delayed."""
    flight = None if state.suspended else state.in_flight
    drone = state.allocated or state.carrier or state.holds
    if state.allocated is None and flight is not None:
        drone = flight.flier
    return {
        "lives": state.task is not None,
        "block": block,
        "drone": drone and drone.id,
        "flies": flight is not None,
        "allocated": state.allocated is not None,
        "until": state.held_until,
        "opens": moment_of(state.mission, "opens", state.core.kernel.drift),
        "deadline": state.mission.deadline,
    }


# Drones


def drone_row(drone: Drone, fleet: Fleet) -> Data:
    """Return the row of a drone."""
    loss = fleet.lost.get(drone)
    return {
        "status": drone.status.value,
        "at": list(drone.location),
        "battery": drone.battery_level,
        "trips": drone.trips,
        "retired": drone in fleet.retired,
        "lost": None if loss is None else {"reason": loss.reason, "at": loss.at},
        "mended": drone in fleet.mended,
    }


def drone_standing(drone: Drone, fleet: Fleet, aside: bool) -> Data:
    """Return a drone's row, and why it is not ready to fly, as `unready`."""
    return {
        **drone_row(drone, fleet),
        "aside": aside,
        **({"ready_at": fleet.queue.ready_at(drone)} if aside else {}),
        "unready": fleet.unready.get(drone, ""),
        "low": fleet.is_low(drone),
        "landed": drone.telemetry.landed,
    }


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
