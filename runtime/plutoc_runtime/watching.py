"""Waiting for the end of a flight, and failing the trip when it takes too long."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from .calling_off import abort
from .kernel import Kernel, Key, Kind

if TYPE_CHECKING:
    from .flight import Flight
    from .kernel import Task
    from .model import Trip
    from .run import Run


Limit = tuple[float, float, Callable[["Trip", float], str]]
"""From when on, how long a trip may take, and what is said, of trip and time, if it takes longer."""

Guard = tuple["Flight", "Task[Any] | None", Key, float, float, Callable[["Trip", float], str]]
"""What is watched, for whom, its place among simultaneous events, and the limit."""


def watch(run: Run[Any], *limits: Limit | None) -> Flight:
    """Return the flight, to be awaited: its end is how the mission stands then.

    A limit fails the trip; a trip that ends at that very instant has ended first. Nothing is watched
    any longer once the branch that asked for it is over.
    """
    flight = run.state.flight
    if flight is None:
        raise RuntimeError(f"mission {run.mission.name} has no flight to watch")
    # behind a hook of the mission's at that instant, as if it stood in a branch of its own
    key = run.key
    for limit in limits:
        key += 1
        if limit is not None:
            run.core.deadlines.watch((flight, run.task, key, *limit))
    return flight


class Deadlines:
    """Every limit that is watched.

    Most flights end long before their limits, and nearly all limits of an app are equally long:
    those expire in the order in which they began. So there is a queue for each length, and one
    timer a queue instead of one a flight.
    """

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._queues: dict[float, deque[Guard]] = {}
        """By length; each has a timer that comes no later than its first limit."""

    def watch(self, guard: Guard) -> None:
        """Fail the flight at its limit, unless it is over by then, or whoever asked for it."""
        span = guard[4]
        if guard[3] != self._kernel.now:  # it began before: it may expire before those that wait
            self._schedule(guard)
            return
        queue = self._queues.get(span)
        if queue is None:
            self._queues[span] = deque((guard,))
            self._arm(span)
            return
        while queue and queue[0][0].is_set:
            queue.popleft()
        queue.append(guard)

    def _schedule(self, guard: Guard) -> None:
        until = guard[3] + guard[4]
        self._kernel.schedule(until, Kind.TIMER, guard[2], partial(_expire, guard))

    def _arm(self, span: float) -> None:
        until = self._queues[span][0][3] + span
        self._kernel.schedule(until, Kind.TIMER, -1, partial(self._due, span))

    def _due(self, span: float) -> None:
        """Let expire what is due, each in its own place among the events of this instant."""
        now, queue = self._kernel.now, self._queues[span]
        while queue and (queue[0][0].is_set or queue[0][3] + span <= now):
            self._schedule(queue.popleft())
        if queue:
            self._arm(span)
        else:
            del self._queues[span]


def _expire(guard: Guard) -> None:
    flight, task, _, _, span, overdue = guard
    if not (flight.is_set or (task is not None and task.is_set)):
        abort(flight.state, overdue(flight.trip, span))
