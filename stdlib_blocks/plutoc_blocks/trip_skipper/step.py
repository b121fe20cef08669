"""What a TripSkipper does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import nothing_to_fly
from plutoc_runtime.domain.keeper import put, trips_of
from plutoc_runtime.domain.status import COMPLETED, STANDBY, TripStatus

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


def skip_trip(run: Run[Any], status: Status) -> Status:
    """Leave the trip that failed out, and go on with the next one."""
    mission = run.mission
    transitions = run.core.transitions
    if not trips_of(mission):
        raise nothing_to_fly(mission.reason)
    trip = run.trip
    put(trip, status=TripStatus.SKIPPED)
    transitions.skip(mission, trip)
    after = STANDBY if trips_of(mission) else COMPLETED
    transitions.modify(mission, after, "")
    return after
