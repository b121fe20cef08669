"""What a PriorityManager does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.errors import MissionFailed
from plutoc_runtime.status import STANDBY, Status

if TYPE_CHECKING:
    from plutoc_runtime.run import Run


def raise_priority(run: Run[Any], status: Status, *, max_attempts: int, priority: int) -> Status:
    """Put the trip that failed back, unless it has been tried often enough."""
    mission = run.mission
    if not mission.trips:
        if max_attempts:
            return status
        raise MissionFailed(mission.reason)
    trip = mission.current
    if max_attempts and trip.attempt >= max_attempts:
        return status
    trip.priority = priority + 1
    run.core.transitions.put_back(mission)
    return STANDBY
