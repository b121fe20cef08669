"""What a MissionCreator does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


def create_mission(run: Run[Any], status: Status) -> Status:
    """Make the mission of the user's trips."""
    run.core.transitions.create(run.mission)
    return status
