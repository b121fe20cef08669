"""Time-outs of trips: each fails the trip that takes longer."""

from __future__ import annotations

from collections import deque
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


class EqualLimits:
    """Limits of one length that say the same, for flights that were launched one after the other."""

    __slots__ = ("branches", "flights", "number", "overdue", "span")

    def __init__(self, number: int, span: float, overdue: Overdue) -> None:
        self.number, self.span, self.overdue = number, span, overdue
        """The place among the limits of a branch, how long, and what is said."""
        self.flights: deque[Flight] = deque()
        self.branches: deque[Branch] = deque()
        """Which branch each flight is watched for."""


class Deadlines:
    """Every limit that is watched.

    Most flights end long before their limits, and nearly all limits of an app are alike: those
    expire in the order in which they began. So there is a queue for each length, and one timer a
    queue instead of one a flight.
    """

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._queues: dict[float, EqualLimits] = {}
        """By length; each has a timer that comes no later than its first limit."""

    def watch(self, branch: Branch, flight: Flight, number: int, limit: Limit) -> None:
        """Fail the flight at its limit, unless it or the branch that asks for it is over by then."""
        since, span, overdue = limit
        queue, now = self._queues.get(span), self._kernel.now
        if since != now or flight.launched_at != now:
            self._schedule(branch, flight, number, limit)  # it may expire before others
        elif queue is None:
            queue = self._queues[span] = EqualLimits(number, span, overdue)
            queue.flights.append(flight)
            queue.branches.append(branch)
            self._arm(queue)
        elif queue.overdue is not overdue or queue.number != number:
            self._schedule(branch, flight, number, limit)
        else:
            flights = queue.flights
            while flights and flights[0].is_set:
                flights.popleft()
                queue.branches.popleft()
            flights.append(flight)
            queue.branches.append(branch)

    def _schedule(self, branch: Branch, flight: Flight, number: int, limit: Limit) -> None:
        since, span, overdue = limit
        # behind a hook of the mission's at that instant, as if it stood in a branch of its own
        key, call = branch.key + number, partial(_expire, branch, flight, span, overdue)
        self._kernel.schedule(since + span, Kind.TIMER, key, call)

    def _arm(self, queue: EqualLimits) -> None:
        until = queue.flights[0].launched_at + queue.span
        self._kernel.schedule(until, Kind.TIMER, -1, partial(self._due, queue))

    def _due(self, queue: EqualLimits) -> None:
        """Let expire what is due, each in its own place among the events of this instant."""
        now, span, flights = self._kernel.now, queue.span, queue.flights
        while flights and (flights[0].is_set or flights[0].launched_at + span <= now):
            flight, branch = flights.popleft(), queue.branches.popleft()
            self._schedule(branch, flight, queue.number, (flight.launched_at, span, queue.overdue))
        if flights:
            self._arm(queue)
        else:
            del self._queues[span]


def _expire(branch: Branch, flight: Flight, span: float, overdue: Overdue) -> None:
    if not (flight.is_set or (branch.task is not None and branch.task.is_set)):
        branch.abort(overdue(flight.trip, span))
