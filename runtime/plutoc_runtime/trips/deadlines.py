"""Time-outs of trips: a trip that takes longer fails."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from ..time.kernel import EventKind, Kernel

if TYPE_CHECKING:
    from ..domain.model import Trip
    from ..time.kernel import Key, Task
    from .flight import Flight


class LimitOwner(Protocol):
    """The branch of a mission that sets a limit; the limit is void once the branch has ended."""

    key: Key
    task: Task[Any] | None

    def abort(self, reason: str) -> None:
        """Fail the trip in flight."""
        ...


class Limit:
    """How long a trip may take, from when on, and the reason that is given if it takes longer."""

    __slots__ = ("overdue", "since", "span")

    def __init__(self, since: float, span: float, overdue: Callable[[Trip, float], str]) -> None:
        self.since, self.span, self.overdue = since, span, overdue

    def set(
        self,
        kernel: Kernel,
        watched: dict[float, EqualLimits],
        branch: LimitOwner,
        flight: Flight,
        number: int,
    ) -> None:
        """Fail the flight at this limit, unless it or the branch that sets it has ended by then.

        `watched` are the app's limits by length, `number` counts this branch's limits.
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
        """Schedule its end with a timer of its own."""
        # after a hook of the mission at that instant, as if it were in a branch of its own
        key, call = branch.key + number, partial(self._expire, branch, flight)
        kernel.schedule(self.since + self.span, EventKind.TIMER, key, call)

    def _expire(self, branch: LimitOwner, flight: Flight) -> None:
        if not (flight.is_set or (branch.task is not None and branch.task.is_set)):
            branch.abort(self.overdue(flight.trip, self.span))


class EqualLimits:
    """Limits of one length and one reason, of flights launched one after the other: one timer."""

    def __init__(
        self, kernel: Kernel, watched: dict[float, EqualLimits], limit: Limit, number: int
    ) -> None:
        self._kernel, self._watched, self.limit, self.number = kernel, watched, limit, number
        self.waiting: deque[tuple[Flight, LimitOwner]] = deque()

    def arm(self) -> None:
        """Set the timer to the first of them."""
        until = self.waiting[0][0].launched_at + self.limit.span
        self._kernel.schedule(until, EventKind.TIMER, -1, self._due)

    def _due(self) -> None:
        kernel, span, waiting = self._kernel, self.limit.span, self.waiting
        while waiting and (waiting[0][0].is_set or waiting[0][0].launched_at + span <= kernel.now):
            flight, branch = waiting.popleft()
            expires = Limit(flight.launched_at, span, self.limit.overdue)
            expires.schedule(kernel, branch, flight, self.number)
        if waiting:
            self.arm()
        else:
            del self._watched[span]
