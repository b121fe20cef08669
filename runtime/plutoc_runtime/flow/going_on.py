"""Going on from the rows of an earlier run, and letting missions that were taken out of their graphs go on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from ..domain.keeper import put, read_only, trips_of
from ..domain.status import RUNNING, STANDBY, UNEXECUTED, Status
from ..fleet.fleet import Loss
from ..fleet.orders import failure_of
from ..hooks.plain_data import item_of, value_of
from .flight import Flight
from .record import result_of, update

if TYPE_CHECKING:
    from ..domain.model import Drone, Trip
    from ..fleet.fleet import Fleet
    from .engine import Engine
    from .mission import Delay, MissionState

Record = Mapping[str, Any]


class GoingOn:
    """Restores the missions of one brain, and resumes them."""

    def __init__(self, engine: Engine) -> None:
        self._core = engine.core
        self._engine = engine
        self._states = engine.states

    # From rows

    def restore(self, standing: Record) -> None:
        """Have missions, drones and results as their rows say; each mission is out of its graph."""
        core = self._core
        for id, row in standing.get("drones", {}).items():
            if (drone := core.fleet.named(id)) is not None:
                _restore_drone(drone, row, core.fleet)
        records = standing.get("missions", {})
        for name in sorted(records, key=lambda name: int(records[name].get("index", 0))):
            self._states[name] = self._restored(name, records[name])
        self._restore_results(standing.get("results", ()))
        for state in self._states.values():
            self._engine.promises.watch(state.mission)
        core.changes.clear(len(core.results.results))
        if seconds := standing.get("shift"):
            self._shift(seconds)

    def _shift(self, seconds: float) -> None:
        """Postpone every pending delay by the seconds in which everything was stopped."""
        for name, state in self._states.items():
            if state.ended or (state.delay is None and state.paused is None):
                continue
            if state.delay is not None:
                place, over, begins = state.delay
                state.delay = (place, over + seconds, begins)
            if state.paused is not None:
                state.paused += seconds
            self._core.changes.mission(name)

    def _restored(self, name: str, record: Record) -> MissionState:
        """Return a mission's state as its record has it; what does not fit the app is kept as it is."""
        core, unfit = self._core, record.get("unfit")
        known = (
            {**record, "todo": (), "done": (), "gone": (), "fields": unfit}
            if unfit is not None
            else record
        )
        index = record.get("index", len(self._states))
        mission = core.app.mission(name=name, trips=[], index=index, **known.get("fields", {}))
        gone = update(core.app, mission, known, self._core.fleet.named)
        put(mission, promises=read_only(mission.promises))
        trips = (*trips_of(mission), *mission.completed_trips)
        keeper = self._engine.keep(mission, (*trips, *gone))
        taken = [trip for trip, round_ in gone.items() if round_ == mission.round]
        keeper.names = dict.fromkeys((trip.name for trip in (*taken, *trips)), 1)
        keeper.changed = bool(record.get("changed"))
        state = self._engine.new_state(mission)
        state.gone = gone
        state.numbered = max((trip.number for trip in (*trips, *gone)), default=0)
        state.ended = bool(record.get("ended"))
        for fact in _AS_THEY_ARE:
            setattr(state, fact, record.get(fact))
        state.judged = state.evaluated = record.get("judged", 0)
        state.interrupted = bool(record.get("interrupted"))
        state.replanned = bool(record.get("replanned"))
        waited = {cast("Delay", tuple(place)) for place in record.get("waited", ())}
        state.waited = waited or None
        if record.get("delay") is not None:
            place, over, begins = record["delay"]
            state.delay = cast("Delay", tuple(place)), over, begins
        if unfit is not None:
            kept = ("status", "reason", "ended", "paused", "question", "held", "answer", "unfit")
            state.unfit = {fact: record[fact] for fact in record if fact not in kept}
            return state
        if record.get("carrier") is not None:
            state.carrier = core.fleet.named(record["carrier"])
            state.carries = item_of(record.get("carries"))
        self._restore_flight(state, record.get("flight"), (*trips, *gone))
        return state

    def _restore_flight(
        self, state: MissionState, row: Record | None, trips: Iterable[Trip]
    ) -> None:
        """Restore the latest flight; one whose end the graph does not know is where that goes on."""
        if row is None:
            return
        trip = next((trip for trip in trips if trip.name == row["trip"]), None)
        drone = self._core.fleet.named(row["drone"])
        if trip is None or drone is None:
            return
        action = self._core.app.actions[trip.action]
        flight = Flight(state.mission, trip, drone, action, row["since"], bool(row.get("retry")))
        flight.round = row["round"]
        flight.attempt = row["attempt"]
        flight.begun = bool(row.get("begun"))
        flight.heard = bool(row.get("heard"))
        beside = row.get("beside")
        flight.beside = None if beside is None else tuple(beside)
        if row.get("outcome") is not None:
            flight.set(Status(row["outcome"]))
        state.flight = flight

    def _restore_results(self, rows: Iterable[Record]) -> None:
        """Restore results, and which of them each evaluator has not seen."""
        trips: dict[tuple[str, object], Trip] = {}
        for name, state in self._states.items():
            mission = state.mission
            for trip in (*state.gone, *trips_of(mission), *mission.completed_trips):
                trips[name, trip.number] = trip
        results = self._core.results
        for row in rows:
            state = self._states[row["mission"]]
            trip = trips.get((row["mission"], row.get("number")))
            number = results.add(result_of(row, state.mission, trip))
            if number >= state.judged:
                put(state.mission, last_result=number)

    # Back into their graphs

    def go_on(self, missions: Mapping[str, Record], drones: Mapping[str, Record]) -> None:
        """Let these missions go on, and take over the drones that none needs.

        A mission may have the `report` of the end of its flight; the others stay out of their graphs.
        """
        core = self._core
        engaged: set[Drone] = set()
        for name, state in self._states.items():
            if state.ended or state.task is not None:
                continue
            if name in missions:
                self._resume(state, missions[name].get("report"), engaged)
            elif drones:
                self._keep_out(state, engaged)
        for id, report in drones.items():
            drone = core.fleet.named(id)
            if drone is not None and drone not in engaged and drone not in core.fleet.errands:
                core.fleet.take_up(drone, report)
        self._engine.look_for_the_end()

    def _keep_out(self, state: MissionState, engaged: set[Drone]) -> None:
        """Keep the drone that has, or may have, a mission's item."""
        flight = state.unsettled
        if flight is not None and flight.trip.item is not None:
            state.holds = flight.flier
        drone = state.carrier or state.holds
        if drone is not None:
            engaged.add(drone)
            state.keep_carrier(drone)

    def _resume(self, state: MissionState, report: Record | None, engaged: set[Drone]) -> None:
        """Let a mission go on; add the drones that it needs."""
        core, mission, flight = self._core, state.mission, state.flight
        held, state.holds = state.holds, None
        if held is not None and held is not state.carrier:
            core.fleet.recover(held)  # it may have had the mission's item
        state.goes_on = False
        if flight is not None and not flight.is_set:
            engaged.add(flight.flier)
            state.goes_on = True
            put(mission, status=RUNNING)
            core.fleet.flies_on(flight.flier)
            self._hear(state, flight, report)
        elif flight is not None:
            state.goes_on = not flight.heard
        if state.carrier is not None and state.carrier not in engaged:
            engaged.add(state.carrier)
            state.keep_carrier(state.carrier)
        if state.doom is not None:  # it is to be ended at once
            return
        resumes = core.app.resumes
        if state.at is not None and state.at not in resumes and resumes:
            state.at = resumes[0]  # a person has said so
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


_AS_THEY_ARE = (
    "at",
    "first_start",
    "last_action_end",
    "paused",
    "question",
    "held",
    "answer",
    "accepted",
)


def _restore_drone(drone: Drone, row: Record, fleet: Fleet) -> None:
    put(drone, trips=row.get("trips", 0))
    if row.get("retired"):
        fleet.retired.add(drone)
    if row.get("mended"):
        fleet.mended.add(drone)
    if row.get("lost") is not None:
        fleet.lost[drone] = Loss(row["lost"]["reason"], row["lost"].get("at"))
