"""In the graph, the only place where a mission or a trip changes its status; each change is an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..domain.status import COMPLETED, FAILED, RUNNING, STANDBY, UNEXECUTED, TripStatus
from ..domain.text import bounded, shown

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, ResultStore, Trip
    from ..domain.status import Status
    from ..domain.trace import Trace
    from ..time.kernel import Kernel

LONGEST = 3_000  # characters of a reason; longer than any that a hook may give


class Transitions:
    """All changes of status."""

    def __init__(self, kernel: Kernel, trace: Trace, results: ResultStore) -> None:
        self._kernel, self._trace, self._results = kernel, trace, results
        self._time = kernel.time

    def create(self, mission: Mission[Any]) -> None:
        """Create a mission with the user's trips."""
        mission.status = UNEXECUTED
        time = self._time
        for trip in mission.trips:
            trip.now = time
        if self._trace.live:
            self._note("mission.created", mission, trips=[trip.name for trip in mission.trips])

    def allocate(
        self, mission: Mission[Any], trip: Trip, drone: Drone, at: str | None, why: str
    ) -> None:
        """Give a trip its drone; `at` is the block where it resumes after an interruption."""
        trip.drone = drone
        if self._trace.live:
            self._note(
                "trip.allocated", mission, trip=trip.name, drone=drone.id, why=why, resumes_at=at
            )

    def launch(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Launch a trip."""
        trip.status, trip.now = _EXECUTING, self._time
        trip.start_time, trip.end_time, trip.reason = self._kernel.now, None, ""
        mission.status, mission.reason = RUNNING, ""
        mission.attempts += 1
        drone.trips += 1
        if self._trace.live:
            self._note_trip("trip.launched", mission, trip, drone)

    def complete(self, mission: Mission[Any], trip: Trip, value: object) -> None:
        """Complete a trip, and store its result."""
        trip.status, trip.end_time = _COMPLETED, self._kernel.now
        trips = mission.trips
        trips.remove(trip)
        mission.completed_trips.append(trip)
        mission.status = STANDBY if trips else COMPLETED
        mission.last_result = self._results.add(mission, trip, mission.round, trip.attempt, value)
        if self._trace.live:
            self._note_trip("trip.completed", mission, trip, trip.drone, value=shown(value))

    def fail(self, mission: Mission[Any], trip: Trip, reason: str) -> None:
        """Fail a trip: it stays first in the list."""
        trip.status, trip.end_time = _FAILED, self._kernel.now
        mission.status, mission.reason = FAILED, bounded(reason, LONGEST)
        trip.reason = mission.reason
        self._note_trip("trip.failed", mission, trip, trip.drone, reason=trip.reason)

    def _note_trip(
        self, event: str, mission: Mission[Any], trip: Trip, drone: Drone | None, **facts: object
    ) -> None:
        flown = {"trip": trip.name, "drone": drone.id if drone else None}
        self._note(event, mission, **flown, round=mission.round, attempt=trip.attempt, **facts)

    def put_back(self, mission: Mission[Any]) -> None:
        """Reset the failed trip for a retry; one that has not flown since keeps its attempt."""
        trip = mission.current
        trip.reset()
        mission.status, mission.reason = STANDBY, ""
        self._note("trip.reset", mission, trip=trip.name, attempt=trip.attempt)

    def redo(self, mission: Mission[Any], trips: tuple[Trip, ...], added: tuple[Trip, ...]) -> None:
        """Give a finished mission trips to repeat, and new ones."""
        for trip in trips:
            mission.completed_trips.remove(trip)
            trip.reset()
        for trip in added:
            trip.added, trip.now = True, self._time
        mission.trips += [*trips, *added]
        mission.status, mission.reason = STANDBY, ""
        again, new = [trip.name for trip in trips], [trip.name for trip in added]
        self._note("mission.extended", mission, redo=again, add=new)

    def begin_again(self, mission: Mission[Any]) -> None:
        """Start a further round of a finished mission, with the user's own trips."""
        mission.round += 1
        for trip in mission.completed_trips:
            if not trip.added:
                trip.reset()
                trip.attempt = 1
                mission.trips.append(trip)
        mission.trips.sort(key=lambda trip: trip.index)
        mission.completed_trips = []
        mission.status, mission.reason = STANDBY, ""
        self._note("mission.repeated", mission, round=mission.round)

    def begin_action(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Record that an action of the app's own begins: from now on it may have been done."""
        self._note("action.begun", mission, trip=trip.name, drone=drone.id)

    def modify(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """Set the status that a modifier returned."""
        mission.status, mission.reason = status, bounded(reason, LONGEST)
        self._note("mission.modified", mission, status=status.value, reason=mission.reason)

    def end(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """End a mission."""
        mission.status, mission.reason = status, bounded(reason, LONGEST)
        self._note("mission.ended", mission, status=status.value, reason=mission.reason)

    def judge_failed(self, mission: Mission[Any], reason: str) -> None:
        """Fail a finished mission that its evaluator did not accept."""
        mission.status, mission.reason = FAILED, bounded(reason, LONGEST)
        self._note("mission.judged", mission, reason=mission.reason)

    def _note(self, event: str, mission: Mission[Any], **facts: object) -> None:
        if self._trace.live:
            self._trace.note(event, mission=mission.name, **facts)


_EXECUTING = TripStatus.EXECUTING
_COMPLETED, _FAILED = TripStatus.COMPLETED, TripStatus.FAILED
