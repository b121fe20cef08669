"""Time-outs of trips: each fails the trip that takes longer."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ..time.kernel import EventKind, Kernel

if TYPE_CHECKING:
    from ..domain.model import Trip
    from ..time.kernel import Key, Task
    from .flight import Flight


class LimitOwner(Protocol):
    """The branch of a mission that asks for a limit; the limit is void once the branch is over."""

    key: Key
    task: Task[Any] | None

    def abort(self, reason: str) -> None:
        """Fail the trip that flies now."""
        ...


class Limit(NamedTuple):
    """How long a trip may take, from when on, and what is said of trip and time if it takes longer."""

    since: float
    span: float
    overdue: Callable[[Trip, float], str]

    def set(
        self,
        kernel: Kernel,
        watched: dict[float, EqualLimits],
        branch: LimitOwner,
        flight: Flight,
        number: int,
    ) -> None:
        """Fail the flight at this limit, unless it or the branch that asks for it is over by then.

        `watched` are the limits of the app by length, `number` is this one's place in its branch.
        Most flights end long before their limits, and those of one length that begin now expire in
        the order in which they began: they share one timer.
        """
        equal = watched.get(self.span)
        if self.since != kernel.now or flight.launched_at != kernel.now:
            self.schedule(kernel, branch, flight, number)  # it may expire before others
        elif equal is None:
            equal = watched[self.span] = EqualLimits(kernel, watched, self, number)
            equal.waiting.append((flight, branch))
            equal.arm()
        elif equal.limit.overdue is not self.overdue or equal.number != number:
            self.schedule(kernel, branch, flight, number)
        else:
            while equal.waiting and equal.waiting[0][0].is_set:
                equal.waiting.popleft()
            equal.waiting.append((flight, branch))

    def schedule(self, kernel: Kernel, branch: LimitOwner, flight: Flight, number: int) -> None:
        """Let it expire in its own place among the events of that instant."""
        # behind a hook of the mission's at that instant, as if it stood in a branch of its own
        key, call = branch.key + number, partial(self._expire, branch, flight)
        kernel.schedule(self.since + self.span, EventKind.TIMER, key, call)

    def _expire(self, branch: LimitOwner, flight: Flight) -> None:
        if not (flight.is_set or (branch.task is not None and branch.task.is_set)):
            branch.abort(self.overdue(flight.trip, self.span))


class EqualLimits:
    """Limits of one length that say the same, of flights that were launched one after the other."""

    def __init__(
        self, kernel: Kernel, watched: dict[float, EqualLimits], limit: Limit, number: int
    ) -> None:
        self._kernel, self._watched, self.limit, self.number = kernel, watched, limit, number
        self.waiting: deque[tuple[Flight, LimitOwner]] = deque()

    def arm(self) -> None:
        """Look again when the first of them is due."""
        until = self.waiting[0][0].launched_at + self.limit.span
        self._kernel.schedule(until, EventKind.TIMER, -1, self._due)

    def _due(self) -> None:
        kernel, span, waiting = self._kernel, self.limit.span, self.waiting
        while waiting and (waiting[0][0].is_set or waiting[0][0].launched_at + span <= kernel.now):
            flight, branch = waiting.popleft()
            expires = self.limit._replace(since=flight.launched_at)
            expires.schedule(kernel, branch, flight, self.number)
        if waiting:
            self.arm()
        else:
            del self._watched[span]
