"""What a TripLauncher does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import RUNNING
from plutoc_runtime.flow.run import launch

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


def launch_trip(run: Run[Any], status: Status) -> Status:
    """Send the allocated drone on the next trip."""
    launch(run)
    return RUNNING
