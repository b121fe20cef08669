"""Waiting for the end of a flight, and failing the trip when it takes too long."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from ..time.kernel import Kernel, Kind
from .flight import abort

if TYPE_CHECKING:
    from ..domain.model import Trip
    from ..flow.run import Run
    from .flight import Flight


Overdue = Callable[["Trip", float], str]
"""What is said, of trip and time, when a limit is over."""

Limit = tuple[float, float, Overdue]
"""From when on, how long a trip may take, and what is said if it takes longer."""


def watch(run: Run[Any], *limits: Limit | None) -> Flight:
    """Return the flight, to be awaited: its end is how the mission stands then.

    A limit fails the trip; a trip that ends at that very instant has ended first. Nothing is watched
    any longer once the branch that asked for it is over.
    """
    flight = run.state.flight
    if flight is None:
        raise RuntimeError(f"mission {run.mission.name} has no flight to watch")
    for number, limit in enumerate(limits, 1):
        if limit is not None:
            since, span, overdue = limit
            run.core.deadlines.watch(run, flight, number, since, span, overdue)
    return flight


class Alike:
    """Limits of one length that say the same, for flights that were launched one after the other."""

    __slots__ = ("flights", "number", "overdue", "runs", "span")

    def __init__(self, number: int, span: float, overdue: Overdue) -> None:
        self.number, self.span, self.overdue = number, span, overdue
        """The place among the limits of a branch, how long, and what is said."""
        self.flights: deque[Flight] = deque()
        self.runs: deque[Run[Any]] = deque()
        """For whom each flight is watched."""


class Deadlines:
    """Every limit that is watched.

    Most flights end long before their limits, and nearly all limits of an app are alike: those
    expire in the order in which they began. So there is a queue for each length, and one timer a
    queue instead of one a flight.
    """

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._queues: dict[float, Alike] = {}
        """By length; each has a timer that comes no later than its first limit."""

    def watch(
        self,
        run: Run[Any],
        flight: Flight,
        number: int,
        since: float,
        span: float,
        overdue: Overdue,
    ) -> None:
        """Fail the flight at its limit, unless it is over by then, or whoever asked for it."""
        queue, now = self._queues.get(span), self._kernel.now
        if since != now or flight.launched_at != now:
            self._schedule(run, flight, number, since, span, overdue)  # it may expire before others
        elif queue is None:
            queue = self._queues[span] = Alike(number, span, overdue)
            queue.flights.append(flight)
            queue.runs.append(run)
            self._arm(queue)
        elif queue.overdue is not overdue or queue.number != number:
            self._schedule(run, flight, number, since, span, overdue)
        else:
            flights = queue.flights
            while flights and flights[0].is_set:
                flights.popleft()
                queue.runs.popleft()
            flights.append(flight)
            queue.runs.append(run)

    def _schedule(
        self,
        run: Run[Any],
        flight: Flight,
        number: int,
        since: float,
        span: float,
        overdue: Overdue,
    ) -> None:
        # behind a hook of the mission's at that instant, as if it stood in a branch of its own
        key, call = run.key + number, partial(_expire, run, flight, span, overdue)
        self._kernel.schedule(since + span, Kind.TIMER, key, call)

    def _arm(self, queue: Alike) -> None:
        until = queue.flights[0].launched_at + queue.span
        self._kernel.schedule(until, Kind.TIMER, -1, partial(self._due, queue))

    def _due(self, queue: Alike) -> None:
        """Let expire what is due, each in its own place among the events of this instant."""
        now, span, flights = self._kernel.now, queue.span, queue.flights
        while flights and (flights[0].is_set or flights[0].launched_at + span <= now):
            flight, run = flights.popleft(), queue.runs.popleft()
            self._schedule(run, flight, queue.number, flight.launched_at, span, queue.overdue)
        if flights:
            self._arm(queue)
        else:
            del self._queues[span]


def _expire(run: Run[Any], flight: Flight, span: float, overdue: Overdue) -> None:
    if not (flight.is_set or (run.task is not None and run.task.is_set)):
        abort(flight.state, overdue(flight.trip, span))
