"""What a TripLauncher does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.flight import launch
from plutoc_runtime.status import RUNNING

if TYPE_CHECKING:
    from plutoc_runtime.run import Run
    from plutoc_runtime.status import Status


def launch_trip(run: Run[Any], status: Status) -> Status:
    """Send the allocated drone on the next trip."""
    drone = run.state.allocated
    if drone is None:
        raise RuntimeError(f"mission {run.mission.name} has no drone to launch")
    launch(run.state, drone)
    return RUNNING
