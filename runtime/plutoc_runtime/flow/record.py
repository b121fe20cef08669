"""The record of a running app: its missions, trips, drones and results as rows of plain data, and back.

A row is all of one of these that survives the app. What hooks can see of it is a function of rows, so it is the
same after a restart as before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict
from dataclasses import fields as dataclass_fields
from typing import TYPE_CHECKING, Any, cast

from ..domain.fields import Entity
from ..domain.keeper import (
    keep,
    keeper_of,
    plain_again,
    put,
    put_trips,
    settled,
    trips_of,
)
from ..domain.model import Result
from ..domain.status import Status, TripStatus
from ..fleet.fleet import Loss
from ..hooks.plain_data import (
    fields_of,
    item_data,
    item_of,
    known_fields,
    point_of,
    trip_data,
    trip_of,
    value_data,
    value_of,
)
from .flight import Flight
from .promises import moment_of

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Drone, Mission, ResultStore, Trip
    from ..domain.trace import Row
    from ..fleet.fleet import Fleet
    from ..hooks.plain_data import Data
    from .mission import Core, Delay, MissionState
    from .transitions import Changes

Record = Mapping[str, Any]


def changed_rows(
    app: App,
    changes: Changes,
    states: Mapping[str, MissionState],
    results: ResultStore,
    fleet: Fleet,
) -> list[Row]:
    """Return the rows that have changed since the last call."""
    for name in changes.missions:
        if states[name].unfit is None:
            _number_trips(states[name], changes)
    rows: list[Row] = []
    for name in changes.missions:
        rows.append(("mission", (name,), mission_row(app, states[name])))
    for trip, name in changes.trips.items():
        rows.append(("trip", (name, trip.number), trip_row(app, trip, states[name].gone)))
    for drone in changes.drones:
        rows.append(("drone", (drone.id,), drone_row(drone, fleet)))
    for number in range(changes.results, len(results.results)):
        rows.append(("result", (number,), result_row(results.results[number])))
    changes.clear(len(results.results))
    return rows


def _number_trips(state: MissionState, changes: Changes) -> None:
    """Number a mission's new trips, and rank all as they stand in their lists."""
    mission = state.mission
    for trips in mission.completed_trips, trips_of(mission), state.gone:
        rank = 0
        for trip in trips:
            rank += 1
            if trip.number and trip.rank >= rank:
                rank = trip.rank
                continue
            if not trip.number:
                state.numbered += 1
                put(trip, number=state.numbered)
            put(trip, rank=rank)
            changes.trips[trip] = mission.name


# Missions


_FACTS = (
    "at",
    "first_start",
    "last_action_end",
    "judged",
    "interrupted",
    "accepted",
    "replanned",
    "ended",
    "paused",
    "question",
    "held",
    "answer",
)
"""What a mission's row has of its state as it is."""

_FLOWN = ("round", "attempt", "retry", "begun", "heard")
"""What a mission's row has of its flight as it is."""

_PUT = ("status", "reason", "ended", "paused", "question", "held", "answer", "unfit")
"""What can change of a mission that does not fit the app; all else is kept as it is."""

_LISTS = {"gone": TripStatus.WAITING, "done": TripStatus.COMPLETED, "todo": TripStatus.WAITING}
"""The lists of a record, and the usual status of the trips in them."""


def mission_of(app: App, data: Record, index: int) -> Mission[Any]:
    """Return a new mission; what the app does not know is left out."""
    index = data.get("index", index)
    return app.mission(
        name=data.get("name", f"{index + 1}"),
        trips=[trip_of(app, one, place) for place, one in enumerate(data["trips"])],
        index=index,
        promises=data.get("promises", {}),
        **known_fields(app, Entity.MISSION, data),
    )


def mission_row(app: App, state: MissionState) -> Data:
    """Return the row of a mission."""
    mission = state.mission
    flight = state.flight
    keeper = keeper_of(mission)
    row: Data = {fact: getattr(state, fact) for fact in _FACTS}
    row.update(
        index=mission.index,
        fields=fields_of(app, Entity.MISSION, settled(mission)),
        round=mission.round,
        attempts=mission.attempts,
        status=mission.status.value,
        reason=mission.reason,
        promises=plain_again(mission.promises),
        late=mission.late,
        delay=state.delay and [list(state.delay[0]), state.delay[1], state.delay[2]],
        waited=sorted(map(list, state.waited or ())),
        flight=flight and _flight_row(flight),
        carrier=None if state.carrier is None else state.carrier.id,
        carries=item_data(state.carries),
        changed=keeper is not None and keeper.changed,
    )
    if state.unfit is not None:
        row.update((fact, one) for fact, one in state.unfit.items() if fact not in _LISTS)
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


def restored(
    core: Core, name: str, row: Record, new_state: Callable[[Mission[Any]], MissionState]
) -> MissionState:
    """Return a mission's state as its row has it; what does not fit the app is kept as it is."""
    unfit = row.get("unfit")
    known = row
    if unfit is not None:
        known = {**row, "todo": (), "done": (), "gone": (), "fields": unfit}
    mission = core.app.mission(name=name, trips=[], index=row["index"], **known.get("fields", {}))
    gone = update(core.app, mission, known, core.fleet.named)
    state = new_state(mission)
    keeper = keeper_of(mission)
    assert keeper is not None
    trips = (*trips_of(mission), *mission.completed_trips)
    keep(keeper, mission, (*trips, *gone))
    taken = [trip for trip, round_ in gone.items() if round_ == mission.round]
    keeper.names = dict.fromkeys((trip.name for trip in (*taken, *trips)), 1)
    keeper.changed = bool(row.get("changed"))
    state.gone = gone
    state.numbered = max((trip.number for trip in (*trips, *gone)), default=0)
    for fact in _FACTS:
        if fact in row:
            setattr(state, fact, row[fact])
    state.evaluated = state.judged
    state.waited = {cast("Delay", tuple(place)) for place in row.get("waited", ())} or None
    if row.get("delay") is not None:
        place, over, begins = row["delay"]
        state.delay = (cast("Delay", tuple(place)), over, begins)
    if unfit is not None:
        state.unfit = {fact: row[fact] for fact in row if fact not in _PUT}
        return state
    if row.get("carrier") is not None:
        state.carrier = core.fleet.named(row["carrier"])
        state.carries = item_of(row.get("carries"))
    if row.get("flight") is not None:
        state.flight = _flight_of(core, mission, row["flight"], (*trips, *gone))
    return state


def update(
    app: App,
    mission: Mission[Any],
    record: Record,
    drone: Callable[[str], Drone | None] | None = None,
) -> dict[Trip, int]:
    """Bring a mission up to date with its record; return the trips that it has no more, with their rounds.

    `drone` returns the drone of a name.
    """
    known = {trip.name: trip for trip in (*trips_of(mission), *mission.completed_trips)}
    lists: dict[str, list[Trip]] = {}
    for which, status in _LISTS.items():
        lists[which] = []
        for data in record.get(which, ()):
            new = trip_of(app, data, status=status)
            trip = new if which == "gone" else known.setdefault(new.name, new)
            copy_trip(new, trip)
            put(trip, number=data.get("number", 0), rank=data.get("rank", 0))
            if drone is not None and "drone" in data:
                put(trip, drone=drone(data["drone"]))
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
    rounds = [data.get("round", 0) for data in record.get("gone", ())]
    return dict(zip(lists["gone"], rounds, strict=True))


def whereabouts_of(state: MissionState) -> Data:
    """Return where a mission is in its graph, which drone it has, and until when it is delayed."""
    flight = None if state.suspended else state.in_flight
    drone = state.allocated or state.carrier or state.holds
    if state.allocated is None and flight is not None:
        drone = flight.flier
    return {
        "lives": state.task is not None,
        "block": "" if state.task is None else state.block,
        "drone": drone and drone.id,
        "flies": flight is not None,
        "allocated": state.allocated is not None,
        "until": state.held_until,
        "opens": moment_of(state.mission, "opens", state.core.kernel.drift),
        "deadline": state.mission.deadline,
    }


def _flight_row(flight: Flight) -> Data:
    row: Data = {fact: getattr(flight, fact) for fact in _FLOWN}
    row["trip"] = flight.trip.name
    row["drone"] = flight.drone
    row["since"] = flight.launched_at
    row["beside"] = flight.beside
    row["outcome"] = flight.result().value if flight.is_set else None
    if flight.relieved:
        row["relieved"] = flight.relieved
    return row


def _flight_of(
    core: Core, mission: Mission[Any], row: Record, trips: Iterable[Trip]
) -> Flight | None:
    """Return the latest flight; None if the app does not know its trip or its drone any more."""
    trip = next((trip for trip in trips if trip.name == row["trip"]), None)
    drone = core.fleet.named(row["drone"])
    if trip is None or drone is None:
        return None
    action = core.app.actions[trip.action]
    flight = Flight(mission, trip, drone, action, row["since"], retry=False)
    for fact in _FLOWN:
        if fact in row:
            setattr(flight, fact, row[fact])
    flight.relieved = row.get("relieved", 0)
    if row.get("beside") is not None:
        flight.beside = point_of(row["beside"])
    if row.get("outcome") is not None:
        flight.set(Status(row["outcome"]))
    return flight


# Trips and results


def trip_row(app: App, trip: Trip, gone: Mapping[Trip, int]) -> Data:
    """Return the row of a trip, without the values that every new trip has."""
    now = settled(trip)
    row = trip_data(app, now)
    if trip.number:
        row["number"] = trip.number
        row["rank"] = trip.rank
    if now.drone is not None:
        row["drone"] = now.drone.id
    if now.start_time is not None:
        row["start_time"] = now.start_time
    if now.end_time is not None:
        row["end_time"] = now.end_time
    if trip.reason:
        row["reason"] = trip.reason
    if trip in gone:
        row["round"] = gone[trip]
    return row


def copy_trip(new: Trip, trip: Trip) -> None:
    """Have a trip be as another, but for the row that it has."""
    if trip is not new:
        facts = {one.name: getattr(new, one.name) for one in dataclass_fields(new)}
        put(trip, **{**facts, "number": trip.number, "rank": trip.rank})


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


def result_of(row: Record, mission: Mission[Any], trip: Trip | None) -> Result[Any, Any]:
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


def restore_results(
    rows: Iterable[Record], states: Mapping[str, MissionState], results: ResultStore
) -> None:
    """Restore results, and which of them each evaluator has not seen."""
    trips: dict[tuple[str, object], Trip] = {}
    for name, state in states.items():
        mission = state.mission
        for trip in (*state.gone, *trips_of(mission), *mission.completed_trips):
            trips[name, trip.number] = trip
    for row in rows:
        state = states[row["mission"]]
        known = trips.get((row["mission"], row.get("number")))
        number = results.add(result_of(row, state.mission, known))
        if number >= state.judged:
            put(state.mission, last_result=number)


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


def restore_drone(drone: Drone, row: Record, fleet: Fleet) -> None:
    """Have a drone as its row says."""
    put(drone, trips=row.get("trips", 0))
    if row.get("retired"):
        fleet.retired.add(drone)
    if row.get("mended"):
        fleet.mended.add(drone)
    if row.get("lost") is not None:
        fleet.lost[drone] = Loss(row["lost"]["reason"], row["lost"].get("at"))


def drone_standing(drone: Drone, fleet: Fleet, aside: bool) -> Data:
    """Return a drone's row, and why it is not ready to fly, as `unready`."""
    row = drone_row(drone, fleet)
    row["aside"] = aside
    if aside:
        row["ready_at"] = fleet.queue.ready_at(drone)
    row["unready"] = fleet.unready.get(drone, "")
    row["low"] = fleet.is_low(drone)
    row["landed"] = drone.telemetry.landed
    return row


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
