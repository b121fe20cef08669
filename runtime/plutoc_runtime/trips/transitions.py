"""In the graph, the only place where a mission or a trip changes its status; each change is an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..domain.keeper import current_of, drop_trip, keeper_of, put, put_trips, trips_of
from ..domain.model import put_back
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

    def create(self, mission: Mission[Any]) -> None:
        """Create a mission with the user's trips."""
        put(mission, status=UNEXECUTED)
        if self._trace.live:
            self._note("mission.created", mission, trips=[trip.name for trip in trips_of(mission)])

    def allocate(
        self, mission: Mission[Any], trip: Trip, drone: Drone, at: str | None, why: str
    ) -> None:
        """Give a trip its drone; `at` is the block where it resumes after an interruption."""
        put(trip, drone=drone)
        if self._trace.live:
            self._note(
                "trip.allocated", mission, trip=trip.name, drone=drone.id, why=why, resumes_at=at
            )

    def launch(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Launch a trip."""
        put(trip, status=_EXECUTING, drone=drone, reason="")  # a hook may have put it first since
        put(trip, start_time=self._kernel.now, end_time=None)
        put(mission, status=RUNNING, reason="", attempts=mission.attempts + 1)
        put(drone, trips=drone.trips + 1)
        if self._trace.live:
            self._note_trip("trip.launched", mission, trip, drone)

    def complete(self, mission: Mission[Any], trip: Trip, value: object) -> None:
        """Complete a trip, and store its result."""
        put(trip, status=_COMPLETED, end_time=self._kernel.now)
        drop_trip(mission, trip)
        put(
            mission,
            completed_trips=(*mission.completed_trips, trip),
            status=STANDBY if trips_of(mission) else COMPLETED,
            last_result=self._results.add(mission, trip, mission.round, trip.attempt, value),
        )
        if self._trace.live:
            self._note_trip("trip.completed", mission, trip, trip.drone, value=shown(value))

    def fail(self, mission: Mission[Any], trip: Trip, reason: str) -> None:
        """Fail a trip: it stays first in the list."""
        reason = bounded(reason, LONGEST)
        put(trip, status=_FAILED, end_time=self._kernel.now, reason=reason)
        put(mission, status=FAILED, reason=reason)
        self._note_trip("trip.failed", mission, trip, trip.drone, reason=trip.reason)

    def _note_trip(
        self, event: str, mission: Mission[Any], trip: Trip, drone: Drone | None, **facts: object
    ) -> None:
        flown = {"trip": trip.name, "drone": drone.id if drone else None}
        self._note(event, mission, **flown, round=mission.round, attempt=trip.attempt, **facts)

    def put_back(self, mission: Mission[Any]) -> None:
        """Reset the failed trip for a retry; one that has not flown since keeps its attempt."""
        trip = current_of(mission)
        put_back(trip)
        put(mission, status=STANDBY, reason="")
        self._note("trip.reset", mission, trip=trip.name, attempt=trip.attempt)

    def redo(self, mission: Mission[Any], trips: tuple[Trip, ...], added: tuple[Trip, ...]) -> None:
        """Give a finished mission trips to repeat, and new ones."""
        for trip in trips:
            put_back(trip)
        done = tuple(one for one in mission.completed_trips if one not in trips)
        put_trips(mission, [*trips_of(mission), *trips, *added])
        put(mission, completed_trips=done, status=STANDBY, reason="")
        again, new = [trip.name for trip in trips], [trip.name for trip in added]
        self._note("mission.extended", mission, redo=again, add=new)

    def begin_again(self, mission: Mission[Any]) -> None:
        """Start a further round of a finished mission, with the user's own trips."""
        own = [trip for trip in mission.completed_trips if not trip.added]
        for trip in own:
            put_back(trip)
        trips = sorted([*trips_of(mission), *own], key=lambda trip: trip.index)
        for trip in trips:
            if trip.status is TripStatus.WAITING:
                put(trip, attempt=1)
        put_trips(mission, trips)
        put(mission, round=mission.round + 1, completed_trips=(), status=STANDBY, reason="")
        if (keeper := keeper_of(mission)) is not None:
            keeper.names = dict.fromkeys((trip.name for trip in trips), 1)
        self._note("mission.repeated", mission, round=mission.round)

    def begin_action(self, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
        """Record that an action of the app's own begins: from now on it may have been done."""
        self._note("action.begun", mission, trip=trip.name, drone=drone.id)

    def modify(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """Set the status that a modifier returned."""
        put(mission, status=status, reason=bounded(reason, LONGEST))
        self._note("mission.modified", mission, status=status.value, reason=mission.reason)

    def end(self, mission: Mission[Any], status: Status, reason: str) -> None:
        """End a mission."""
        put(mission, status=status, reason=bounded(reason, LONGEST))
        self._note("mission.ended", mission, status=status.value, reason=mission.reason)

    def judge_failed(self, mission: Mission[Any], reason: str) -> None:
        """Fail a finished mission that its evaluator did not accept."""
        put(mission, status=FAILED, reason=bounded(reason, LONGEST))
        self._note("mission.judged", mission, reason=mission.reason)

    def _note(self, event: str, mission: Mission[Any], **facts: object) -> None:
        if self._trace.live:
            self._trace.note(event, mission=mission.name, **facts)


_EXECUTING = TripStatus.EXECUTING
_COMPLETED, _FAILED = TripStatus.COMPLETED, TripStatus.FAILED
