"""What a TripLauncher does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import RUNNING

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


def launch_trip(run: Run[Any], status: Status) -> Status:
    """Send the allocated drone on the next trip."""
    state = run.state
    drone = state.allocated
    if drone is not None:
        state.launch(drone)
    elif state.goes_on:
        state.goes_on = False  # the trip was launched before the mission was interrupted
    else:
        raise RuntimeError(f"mission {run.mission.name} has no drone to launch")
    return RUNNING
