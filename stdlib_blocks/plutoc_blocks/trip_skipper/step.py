"""What a TripSkipper does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.keeper import current_of, put, trips_of
from plutoc_runtime.domain.status import COMPLETED, STANDBY, Status, TripStatus

if TYPE_CHECKING:
    from plutoc_runtime.flow.run import Run


def skip_trip(run: Run[Any], status: Status) -> Status:
    """Leave the failed trip out, and go on with the next one; COMPLETED when none is left."""
    mission = run.mission
    trip = current_of(mission)
    put(trip, status=TripStatus.SKIPPED)
    run.core.transitions.skip(mission, trip)
    status = STANDBY if trips_of(mission) else COMPLETED
    run.core.transitions.modify(mission, status, "")
    return status
