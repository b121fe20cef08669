"""What the events of a run must say so that another run can go on from them, and going on.

Each mission stands as its record says, and the flights with it, with what is reported of the drones.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from ..domain.fields import Entity
from ..domain.keeper import current_of, put, trips_of
from ..domain.status import RUNNING, STANDBY, UNEXECUTED, Status
from ..fleet.orders import failure_of
from ..hooks.plain_data import (
    fields_of,
    item_of,
    mission_data,
    trip_data,
    value_data,
    value_of,
)
from ..time.kernel import Future
from ..trips.flight import Flight
from .standing import update

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Drone, Mission, ResultStore, Trip
    from ..domain.trace import Event
    from ..hooks.plain_data import Data
    from .engine import Engine
    from .mission import Delay, MissionState

Record = Mapping[str, Any]


class Recording:
    """Adds to events what a later run must know, and waits until they are durable."""

    def __init__(
        self,
        app: App,
        states: Mapping[str, MissionState],
        results: ResultStore,
        events: list[Event],
    ) -> None:
        self._app, self._states, self._results, self._events = app, states, results, events
        self._said = self._durable = 0
        """How many events there were, and how many of them are durable."""
        self._waiting: deque[tuple[int, Future[None]]] = deque()

    def hear(self, event: Event) -> None:
        """Keep an event, with what is added to it."""
        self._said += 1
        added = self._added(event)
        self._events.append({**event, **added} if added else event)

    def _added(self, event: Event) -> Data:
        """Return what is added to an event that has just happened."""
        match event["event"]:
            case "mission.created" | "mission.promised":
                return {"plan": mission_data(self._app, self._mission(event))}
            case "trip.completed":
                return {"result": value_data(self._results.results[-1].value)}
            case "trip.reset":
                return {
                    "fields": fields_of(self._app, Entity.TRIP, current_of(self._mission(event)))
                }
            case "mission.extended":
                names = cast("list[str]", event["add"])
                trips = trips_of(self._mission(event))
                return {
                    "trips": [trip_data(self._app, trip) for trip in trips if trip.name in names]
                }
        return {}

    def _mission(self, event: Event) -> Mission[Any]:
        return self._states[str(event["mission"])].mission

    async def on_record(self) -> None:
        """Wait until everything up to now is durable."""
        if self._durable < self._said:
            durable: Future[None] = Future()
            self._waiting.append((self._said, durable))
            await durable

    def durable(self, message: Mapping[str, int]) -> None:
        """Called when so many events are durable."""
        self._durable = max(self._durable, message["durable"])
        while self._waiting and self._waiting[0][0] <= self._durable:
            self._waiting.popleft()[1].set(None)


class Restorer:
    """Restores the missions of one brain."""

    def __init__(self, engine: Engine) -> None:
        self._core, self._engine, self._states = engine.core, engine, engine.states
        self.drones = {drone.id: drone for drone in engine.core.fleet.drones}
        self._trips: dict[str, dict[str, Trip]] = {}

    def go_on(self, standing: Record, drones: Mapping[str, Record]) -> None:
        """Resume every mission that has not ended, and take over the drones that none needs."""
        core, records = self._core, standing.get("missions", {})
        by_index = sorted(records, key=lambda name: int(records[name].get("index", 0)))
        for name in by_index:
            before = self._states.get(name)
            self._states[name] = state = self.restored(name, records[name])
            self._engine.promises.watch(state.mission)
            had = None if before is None or not before.suspended else before.carrier
            if had not in (None, state.carrier):
                core.fleet.recover(had)  # it may have had the mission's item
        self._restore_results(standing.get("results", ()), standing.get("first_result", 0), records)
        for drone, flown in standing.get("flown", {}).items():
            if drone in self.drones:
                put(self.drones[drone], trips=flown)
        engaged: set[Drone] = set()
        for name in by_index:
            if not records[name].get("ended"):
                self._resume(self._states[name], records[name], engaged)
        for id, report in drones.items():
            if id in self.drones and self.drones[id] not in engaged:
                core.fleet.take_up(self.drones[id], report)
        self._engine.look_for_the_end()

    def restored(self, name: str, record: Record) -> MissionState:
        """Return a mission's state as its record has it."""
        core, known = self._core, self._states.get(name)
        index = record.get("index", len(self._states))
        given = {"name": name, "trips": [], "index": index, **record.get("fields", {})}
        mission = known.mission if known else core.app.mission(**given)
        self._trips[name] = trips = update(core.app, mission, record)
        keeper = self._engine.keep(mission, trips.values())
        gone = [one["name"] for one in record.get("gone", ()) if one.get("round") == mission.round]
        left = (*trips_of(mission), *mission.completed_trips)
        keeper.names = dict.fromkeys((*gone, *(trip.name for trip in left)), 1)
        keeper.changed = keeper.changed or bool(record.get("changed"))
        state = self._engine.new_state(mission)
        state.ended = bool(record.get("ended"))
        state.at, state.interrupted = record.get("at"), bool(record.get("interrupted"))
        state.first_start = record.get("first_start")
        state.last_action_end = record.get("last_action_end")
        waited = {cast("Delay", tuple(place)) for place in record.get("waited", ())}
        if known is not None:  # it was paused: this brain knows better where it was
            state.at = known.at if known.at in core.app.resumes else state.at
            waited |= known.waited or set()
        state.waited = waited or None
        if record.get("delay") is not None:
            place, over, begins = record["delay"]
            state.delay = cast("Delay", tuple(place)), over, begins
        if record.get("carrier") is not None:
            state.carrier = self.drones[record["carrier"]]
            state.carries = item_of(record.get("carries"))
        self._restore_flight(state, record.get("flight"), trips)
        return state

    def _restore_flight(
        self, state: MissionState, known: Record | None, trips: Mapping[str, Trip]
    ) -> None:
        """Restore the latest flight; one that has ended unknown to its graph is where that goes on.

        `outcome`: how it ended, None: it may still fly; `heard`: its graph has gone on from that end.
        """
        trip = None if known is None else trips.get(known["trip"])
        if known is None or trip is None:
            return
        outcome, heard = known.get("outcome"), known.get("heard")
        if outcome is None and heard:
            return
        drone = self.drones[known["drone"]]
        put(trip, drone=drone)
        action, retry = self._core.app.actions[trip.action], bool(known.get("retry"))
        state.flight = flight = Flight(state.mission, trip, drone, action, known["since"], retry)
        if outcome is not None:
            flight.set(Status(outcome))
            state.goes_on = not heard

    def _restore_results(
        self, results: Iterable[Any], first: int, records: Mapping[str, Record]
    ) -> None:
        """Restore results, and which of them each evaluator has not seen."""
        for number, (name, trip, round_, attempt, value) in enumerate(results, first):
            mission, gave = self._states[name].mission, value_of(value)
            found = self._trips[name].get(trip)
            kept = self._core.results.add(mission, found, round_, attempt, gave)
            if number >= records[name].get("judged", 0):
                put(mission, last_result=kept)

    def _resume(self, state: MissionState, record: Record, engaged: set[Drone]) -> None:
        """Resume a mission, unless it is suspended; add the drones that it needs."""
        core, mission, flight = self._core, state.mission, state.flight
        suspended = bool(record.get("suspended"))
        if flight is not None and not flight.is_set:
            if not suspended:
                engaged.add(flight.flier)
                state.goes_on = True
                put(mission, status=RUNNING)
                core.fleet.flies_on(flight.flier)
                self._hear(state, flight, record["flight"].get("report"))
            else:
                state.flight = None
                if flight.trip.item is not None:
                    state.carrier = flight.flier
        if state.carrier is not None and state.carrier not in engaged:
            engaged.add(state.carrier)
            state.keep_carrier(state.carrier)
        if suspended or state.doom is not None:  # or it is to be ended at once
            return
        status = STANDBY if mission.attempts or state.interrupted else UNEXECUTED
        if not state.goes_on:
            put(mission, status=status, reason="")
        self._engine.enter(state, status)

    def _hear(self, state: MissionState, flight: Flight, report: Record | None) -> None:
        """Register for the end of a flight; if it is known, report it at once, before any time-out."""
        if report is None:
            self._core.orders.attach(flight.drone, partial(state.reported, flight), flight.id)
        else:
            failed = "failure" in report
            state.reported(flight, failure_of(report) if failed else value_of(report.get("value")))
