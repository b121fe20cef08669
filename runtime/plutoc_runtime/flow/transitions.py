"""In the graph, the only place where a mission or a trip changes its status; each change is an event."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.fields import Entity
from ..domain.keeper import (
    current_of,
    drop_trip,
    keeper_of,
    plain_again,
    put,
    put_trips,
    trips_of,
)
from ..domain.model import Result, put_back
from ..domain.status import COMPLETED, FAILED, RUNNING, STANDBY, UNEXECUTED, TripStatus
from ..domain.text import bounded, shown
from ..hooks.plain_data import fields_of, mission_data, trip_data, value_data

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Drone, Mission, ResultStore, Trip
    from ..domain.status import Status
    from ..domain.trace import Trace
    from ..time.kernel import Kernel
    from .flight import Flight

LONGEST = 3_000  # characters of a reason; longer than any that a hook may give


class Stands(Protocol):
    """What is known of a mission beside what hooks see of it."""

    flight: Flight | None
    gone: dict[Trip, int]
    evaluated: int
    judged: int


class Changes:
    """Which missions, trips and drones have changed since their rows were taken."""

    def __init__(self, states: Mapping[str, Stands], *, kept: bool) -> None:
        """`kept`: whether rows are kept at all; else nothing is noted."""
        self._states = states
        self.kept = kept
        self.missions: dict[str, None] = {}
        self.trips: dict[Trip, str] = {}
        """With the names of their missions."""
        self.drones: dict[Drone, None] = {}
        self.results = 0
        """How many results are known."""

    def mission(self, name: str) -> None:
        """Note that a mission has changed."""
        if self.kept:
            self.missions[name] = None

    def trip(self, mission: Mission[Any], trip: Trip) -> None:
        """Note that a trip has changed, and its mission."""
        if self.kept:
            self.missions[mission.name] = None
            self.trips[trip] = mission.name

    def drone(self, drone: Drone) -> None:
        """Note that a drone has changed."""
        if self.kept:
            self.drones[drone] = None

    def moved_on(self, mission: Mission[Any]) -> None:
        """Note that a mission's graph has gone on from the end of its last flight."""
        state = self._states.get(mission.name)
        if state is None:
            return  # it is just being created
        if state.flight is not None:
            state.flight.heard = True
        state.judged = state.evaluated
        if self.kept:
            self.missions[mission.name] = None

    def leave(self, mission: Mission[Any], trips: Iterable[Trip]) -> None:
        """Note that a mission has these trips no more; in its round their names are taken."""
        state = self._states.get(mission.name)
        if state is None:
            return
        for trip in trips:
            state.gone[trip] = mission.round
            self.trip(mission, trip)

    def clear(self, results: int) -> None:
        """Forget what has changed: all of it is known, and so many results."""
        self.missions.clear()
        self.trips.clear()
        self.drones.clear()
        self.results = results


class Transitions:
    """All changes of status: each changes rows, and notes one event."""

    def __init__(
        self, app: App, kernel: Kernel, trace: Trace, results: ResultStore, changes: Changes
    ) -> None:
        self._app = app
        self._kernel = kernel
        self._trace = trace
        self._results = results
        self._changes = changes
        self.noted = trace.live or changes.kept
        """Whether anyone hears of changes: it takes longer to say them than to make them."""

    def note(self, event: str, mission: Mission[Any], **facts: object) -> None:
        """Note an event of a mission whose row has changed."""
        if self.noted:
            self._changes.mission(mission.name)
            self._trace.note(event, mission=mission.name, **facts)

    def note_trip(self, event: str, mission: Mission[Any], trip: Trip, **facts: object) -> None:
        """Note an event of a trip whose row has changed."""
        if self.noted:
            self._changes.trip(mission, trip)
            self._trace.note(event, mission=mission.name, trip=trip.name, **facts)

    def note_flight(self, event: str, mission: Mission[Any], trip: Trip, **facts: object) -> None:
        drone = trip.drone and trip.drone.id
        flown = {"drone": drone, "round": mission.round, "attempt": trip.attempt}
        self.note_trip(event, mission, trip, **flown, **facts)

    # Missions

    def promise(self, mission: Mission[Any]) -> None:
        """Note what the plan promises of a mission."""
        promises = plain_again(mission.promises)
        self.note("mission.promised", mission, **promises, **self._plan_of(mission))

    def create(self, mission: Mission[Any]) -> None:
        """Create a mission with the user's trips."""
        put(mission, status=UNEXECUTED)
        names = [trip.name for trip in trips_of(mission)]
        self.note("mission.created", mission, trips=names, **self._plan_of(mission))

    def _plan_of(self, mission: Mission[Any]) -> dict[str, object]:
        """Return what a journal must have of a new mission, whose trips have rows from now on."""
        if not self._changes.kept:
            return {}
        for trip in trips_of(mission):
            self._changes.trip(mission, trip)
        return {"plan": mission_data(self._app, mission)}

    def redo(self, mission: Mission[Any], trips: tuple[Trip, ...], added: tuple[Trip, ...]) -> None:
        """Give a finished mission trips to repeat, and new ones."""
        for trip in trips:
            put_back(trip)
        done = tuple(one for one in mission.completed_trips if one not in trips)
        put_trips(mission, [*trips_of(mission), *trips, *added])
        put(mission, completed_trips=done, status=STANDBY, reason="")
        for trip in (*trips, *added):
            self._changes.trip(mission, trip)
        self._changes.moved_on(mission)
        facts: dict[str, object] = {}
        if self._changes.kept:
            facts["trips"] = [trip_data(self._app, trip) for trip in added]
        again = [trip.name for trip in trips]
        new = [trip.name for trip in added]
        self.note("mission.extended", mission, redo=again, add=new, **facts)

    def begin_again(self, mission: Mission[Any]) -> None:
        """Start a further round of a finished mission, with the user's own trips."""
        own = [trip for trip in mission.completed_trips if not trip.added]
        self._changes.leave(mission, [trip for trip in mission.completed_trips if trip.added])
        for trip in own:
            put_back(trip)
        trips = sorted([*trips_of(mission), *own], key=lambda trip: trip.index)
        for trip in trips:
            if trip.status is TripStatus.WAITING:
                put(trip, attempt=1)
            self._changes.trip(mission, trip)
        put_trips(mission, trips)
        put(mission, round=mission.round + 1, completed_trips=(), status=STANDBY, reason="")
        if (keeper := keeper_of(mission)) is not None:
            keeper.names = dict.fromkeys((trip.name for trip in trips), 1)
        self._changes.moved_on(mission)
        self.note("mission.repeated", mission, round=mission.round)

    def replan(self, mission: Mission[Any], trips: list[Trip]) -> None:
        """Put these in place of all trips to do."""
        names = {trip.name for trip in trips}
        left = [trip for trip in trips_of(mission) if trip.name not in names]
        put_trips(mission, trips)
        for trip in trips:
            self._changes.trip(mission, trip)
        self._changes.leave(mission, left)
        todo = [trip_data(self._app, trip) for trip in trips]
        done = [trip_data(self._app, trip) for trip in mission.completed_trips]
        fields = fields_of(self._app, Entity.MISSION, mission)
        self.note("mission.replanned", mission, todo=todo, done=done, fields=fields)

    def modify(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """Set the status that a modifier returned."""
        if status in (STANDBY, UNEXECUTED):
            self._changes.moved_on(mission)
        self._become("mission.modified", mission, status, reason, status=status.value)

    def judge_failed(self, mission: Mission[Any], reason: str) -> None:
        """Fail a finished mission that its evaluator did not accept."""
        self._become("mission.judged", mission, FAILED, reason)

    def end(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """End a mission."""
        self._become("mission.ended", mission, status, reason, status=status.value)

    def _become(
        self, event: str, mission: Mission[Any], to: Status, reason: str, **facts: object
    ) -> None:
        put(mission, status=to, reason=bounded(reason, LONGEST))
        self.note(event, mission, **facts, reason=mission.reason)

    # Trips

    def allocate(
        self, mission: Mission[Any], trip: Trip, drone: Drone, at: str | None, why: str
    ) -> None:
        """Give a trip its drone; `at` is the block where it resumes after an interruption."""
        put(trip, drone=drone)
        self._changes.moved_on(mission)
        if self.noted:
            facts = {"drone": drone.id, "why": why, "resumes_at": at}
            self.note_trip("trip.allocated", mission, trip, **facts)

    def launch(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Launch a trip."""
        put(trip, status=_EXECUTING, drone=drone, reason="")  # a hook may have put it first since
        put(trip, start_time=self._kernel.now, end_time=None)
        put(mission, status=RUNNING, reason="", attempts=mission.attempts + 1)
        put(drone, trips=drone.trips + 1)
        if self.noted:
            self._changes.drone(drone)
            self.note_flight("trip.launched", mission, trip)

    def begin_action(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Record that an action of the app's own begins: from now on it may have been done."""
        self.note("action.begun", mission, trip=trip.name, drone=drone.id)

    def complete(
        self, mission: Mission[Any], trip: Trip, value: object, *, found_out: bool = False
    ) -> None:
        """Complete a trip, and store its result; `found_out`: only after an interruption."""
        now = self._kernel.now
        put(trip, status=_COMPLETED, end_time=now)
        drop_trip(mission, trip)
        place = None if trip.drone is None else trip.drone.location
        result = Result(mission, trip, mission.round, trip.attempt, value, now, place)
        put(
            mission,
            completed_trips=(*mission.completed_trips, trip),
            status=STANDBY if trips_of(mission) else COMPLETED,
            last_result=self._results.add(result),
        )
        if not self.noted:
            return
        facts: dict[str, object] = {"value": shown(value)}
        if self._changes.kept:
            facts["result"] = value_data(value)
            facts["did"] = trip_data(self._app, trip)
        if found_out:
            facts["found_out"] = True
        self.note_flight("trip.completed", mission, trip, **facts)

    def fail(self, mission: Mission[Any], trip: Trip, reason: str) -> None:
        """Fail a trip: it stays first in the list."""
        reason = bounded(reason, LONGEST)
        put(trip, status=_FAILED, end_time=self._kernel.now, reason=reason)
        put(mission, status=FAILED, reason=reason)
        self.note_flight("trip.failed", mission, trip, reason=reason)

    def interrupt(self, mission: Mission[Any], trip: Trip, **why: str) -> None:
        """Take back a flight whose action was not done: it counts as no attempt."""
        put(trip, status=TripStatus.WAITING, drone=None, start_time=None, end_time=None)
        put(mission, status=STANDBY, reason="", attempts=mission.attempts - 1)
        self._changes.moved_on(mission)
        self.note_trip("trip.interrupted", mission, trip, **why)

    def put_back(self, mission: Mission[Any]) -> None:
        """Reset the failed trip for a retry; one that has not flown since keeps its attempt."""
        trip = current_of(mission)
        put_back(trip)
        put(mission, status=STANDBY, reason="")
        self._changes.moved_on(mission)
        facts: dict[str, object] = {"attempt": trip.attempt}
        if self._changes.kept:
            facts["fields"] = fields_of(self._app, Entity.TRIP, trip)
        self.note_trip("trip.reset", mission, trip, **facts)

    def skip(self, mission: Mission[Any], trip: Trip) -> None:
        """Take away a trip that shall not be flown."""
        drop_trip(mission, trip)
        self._changes.leave(mission, (trip,))
        self.note("trip.skipped", mission, trip=trip.name)

    def prioritise(self, mission: Mission[Any], trip: Trip, priority: int) -> None:
        """Set the priority of a trip."""
        put(trip, priority=priority)
        self.note_trip("trip.prioritised", mission, trip, priority=priority)


_EXECUTING = TripStatus.EXECUTING
_COMPLETED = TripStatus.COMPLETED
_FAILED = TripStatus.FAILED
