"""Time-outs of trips: each fails the trip that takes longer."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from ..time.kernel import Kernel, Kind

if TYPE_CHECKING:
    from ..domain.model import Trip
    from ..time.kernel import Key, Task
    from .flight import Flight


Overdue = Callable[["Trip", float], str]
"""What is said, of trip and time, when a limit is over."""

Limit = tuple[float, float, Overdue]
"""From when on, how long a trip may take, and what is said if it takes longer."""


class Branch(Protocol):
    """The branch of a mission that asks for a limit; the limit is void once the branch is over."""

    key: Key
    task: Task[Any] | None

    def abort(self, reason: str) -> None:
        """Fail the trip that flies now."""
        ...


def set_deadline(kernel: Kernel, branch: Branch, flight: Flight, number: int, limit: Limit) -> None:
    """Fail the flight at its limit, unless it or the branch that asks for it is over by then.

    `number` is the limit's place among those of the branch.
    """
    since, span, overdue = limit
    # behind a hook of the mission's at that instant, as if it stood in a branch of its own
    key, call = branch.key + number, partial(_expire, branch, flight, span, overdue)
    kernel.schedule(since + span, Kind.TIMER, key, call)


def _expire(branch: Branch, flight: Flight, span: float, overdue: Overdue) -> None:
    if not (flight.is_set or (branch.task is not None and branch.task.is_set)):
        branch.abort(overdue(flight.trip, span))
