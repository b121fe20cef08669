"""What a MissionRepeater does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import STANDBY, Status

if TYPE_CHECKING:
    from plutoc_runtime.flow.run import Run


def repeat_mission(run: Run[Any], status: Status, *, repeat: int | bool) -> Status:
    """Begin a further round, if the user asked for one."""
    if repeat is not True and run.mission.round >= repeat:
        return status
    run.state.last_action_end = None
    run.core.transitions.begin_again(run.mission)
    return STANDBY
