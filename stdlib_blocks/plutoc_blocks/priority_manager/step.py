"""What a PriorityManager does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import nothing_to_fly
from plutoc_runtime.domain.keeper import put, trips_of
from plutoc_runtime.domain.status import STANDBY, Status, TripStatus

if TYPE_CHECKING:
    from plutoc_runtime.flow.run import Run


def raise_priority(run: Run[Any], status: Status, *, max_attempts: int, priority: int) -> Status:
    """Put the trip that failed back, unless it has been tried often enough."""
    mission = run.mission
    if not trips_of(mission):
        raise nothing_to_fly(mission.reason)
    trip = run.trip
    flown = trip.attempt - (trip.status is TripStatus.WAITING)  # its next attempt is no flight yet
    if max_attempts and flown >= max_attempts:
        return status
    put(trip, priority=priority + 1)
    run.core.transitions.put_back(mission)
    return STANDBY
