"""Resuming missions from their records, with what is reported of the drones."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.status import RUNNING, STANDBY, UNEXECUTED, Status
from ..fleet.orders import failure_of
from ..hooks.plain_data import item_of, value_of
from .standing import update

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from .engine import Engine
    from .mission import Core, MissionState

Record = Mapping[str, Any]


class Restorer:
    """Restores the missions of one brain; each stands as its record says, and the flights with it."""

    def __init__(self, core: Core, engine: Engine, states: dict[str, MissionState]) -> None:
        self._core, self._engine, self._states = core, engine, states
        self._drones = {drone.id: drone for drone in core.fleet.drones}
        self._trips: dict[str, dict[str, Trip]] = {}

    def go_on(self, standing: Record, drones: Mapping[str, Record]) -> None:
        """Resume every mission that has not ended, and take over the drones that none needs."""
        core, records = self._core, standing.get("missions", {})
        by_index = sorted(records, key=lambda name: int(records[name].get("index", 0)))
        for name in by_index:
            self._states[name] = self.restored(name, records[name])
            before = self._engine.suspended.pop(name, None)
            if before is not None and before.carrier not in (None, self._states[name].carrier):
                core.fleet.recover(before.carrier)  # it may have had the mission's item
        self._restore_results(standing.get("results", ()), standing.get("first_result", 0), records)
        for drone, flown in standing.get("flown", {}).items():
            if drone in self._drones:
                self._drones[drone].trips = flown
        engaged: set[Drone] = set()
        for name in by_index:
            if not records[name].get("ended"):
                self._resume(self._states[name], records[name], engaged)
        for id, report in drones.items():
            if id in self._drones and self._drones[id] not in engaged:
                core.fleet.take_up(self._drones[id], report)
        self._engine.look_for_the_end()

    def restored(self, name: str, record: Record) -> MissionState:
        """Return a mission's state as its record has it."""
        core, known = self._core, self._states.get(name)
        if known is None:
            mission: Mission[Any] = core.app.mission(
                name=name, trips=[], index=record.get("index", len(self._states))
            )
        else:
            mission = known.mission
        self._trips[name] = trips = update(core.app, mission, record)
        for trip in trips.values():
            trip.now = core.kernel.time
        state = self._engine.new_state(mission)
        state.ended = bool(record.get("ended"))
        state.at, state.interrupted = record.get("at"), bool(record.get("interrupted"))
        state.first_start = record.get("first_start")
        state.last_action_end = record.get("last_action_end")
        waited = {_place(place) for place in record.get("waited", ())}
        if known is not None:  # it was paused: this brain knows better where it was
            state.at = known.at if known.at in core.app.resumes else state.at
            waited |= known.waited or set()
        state.waited = waited or None
        if record.get("delay") is not None:
            place, over, begins = record["delay"]
            state.delay = _place(place), over, begins
        if record.get("carrier") is not None:
            state.carrier = self._drones[record["carrier"]]
            state.carries = item_of(record.get("carries"))
        self._restore_flight(state, record.get("flight"), trips)
        return state

    def _restore_flight(
        self, state: MissionState, known: Record | None, trips: Mapping[str, Trip]
    ) -> None:
        trip = None if known is None else trips.get(known["trip"])
        if known is None or trip is None or (known.get("outcome") is None and known.get("heard")):
            return
        trip.drone = drone = self._drones[known["drone"]]
        state.flight = flight = state.new_flight(trip, drone, bool(known.get("retry")))
        flight.launched_at = known["since"]
        if known.get("outcome") is not None:
            flight.set(Status(known["outcome"]))
            state.goes_on = not known.get("heard")

    def _restore_results(
        self, results: Iterable[Any], first: int, records: Mapping[str, Record]
    ) -> None:
        """Restore results, and which of them each evaluator has not seen."""
        for number, (name, trip, round_, attempt, value) in enumerate(results, first):
            mission, gave = self._states[name].mission, value_of(value)
            found = self._trips[name].get(trip)
            kept = self._core.results.add(mission, found, round_, attempt, gave)
            if number >= records[name].get("judged", 0):
                mission.last_result = kept

    def _resume(self, state: MissionState, record: Record, engaged: set[Drone]) -> None:
        """Resume a mission, or suspend it; add the drones that it needs."""
        core, mission, flight = self._core, state.mission, state.flight
        unsettled = flight is not None and not flight.is_set
        if record.get("suspended"):
            self._engine.suspended[mission.name] = state
            if flight is not None and unsettled:
                state.flight = None
                if flight.trip.item is not None:
                    state.carrier = flight.flier
        elif flight is not None and unsettled:
            engaged.add(flight.flier)
            state.goes_on, mission.status = True, RUNNING
            core.fleet.flies_on(flight.flier)
            self._hear(state, record["flight"].get("report"))
        if state.carrier is not None and state.carrier not in engaged:
            engaged.add(state.carrier)
            state.keep_carrier(state.carrier)
        if mission.name in self._engine.suspended:
            return
        if state.doom is not None:  # to be ended at once
            self._engine.suspended[mission.name] = state
            return
        status = STANDBY if mission.attempts or state.interrupted else UNEXECUTED
        if not state.goes_on:
            mission.status, mission.reason = status, ""
        self._engine.enter(state, status)

    def _hear(self, state: MissionState, report: Record | None) -> None:
        """Register for the end of a flight; if it is known, report it at once, before any time-out."""
        flight = state.flight
        assert flight is not None
        if report is None:
            self._core.orders.attach(flight.drone, partial(state.reported, flight), flight.id)
        elif "failure" in report:
            state.reported(flight, failure_of(report))
        else:
            state.reported(flight, value_of(report.get("value")))


def _place(place: Iterable[Any]) -> tuple[str, str, int, int]:
    block, trip, round_, attempt = place
    return block, trip, round_, attempt
