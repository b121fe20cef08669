"""Waiting for the end of a flight, and failing the trip when it takes too long."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .flight import abort
from .kernel import Kernel, Key, Kind

if TYPE_CHECKING:
    from .flight import Flight
    from .model import Trip
    from .run import Run
    from .status import Status


class Limit:
    """How long a trip may take, from when on, and how to say that it took longer."""

    __slots__ = ("flight", "key", "overdue", "since", "span")

    def __init__(self, since: float, span: float, overdue: Callable[[Trip, float], str]) -> None:
        self.since, self.span, self.overdue = since, span, overdue
        self.flight: Flight | None = None
        """What is watched; None: nothing any longer."""
        self.key: Key = ()

    @property
    def idle(self) -> bool:
        """Whether nothing is left to watch."""
        return self.flight is None or self.flight.is_set

    def expire(self) -> None:
        """Fail the trip, if it is still watched."""
        flight = self.flight
        if flight is not None and not flight.is_set:
            abort(flight.core, flight.state, self.overdue(flight.trip, self.span))


async def watch(run: Run[Any], *limits: Limit | None) -> Status:
    """Wait for the end of the flight, and say how the mission stands then.

    A limit fails the trip; a trip that ends at that very instant has ended first.
    """
    flight = run.state.flight
    if flight is None:
        raise RuntimeError(f"mission {run.mission.name} has no flight to watch")
    if flight.is_set:
        return flight.result()
    for number, limit in enumerate(limits):
        if limit is not None:
            limit.flight = flight
            limit.key = (*run.key, number) if number else run.key
            run.core.deadlines.watch(limit)
    try:
        return await flight
    except BaseException:  # called off: whoever goes on decides what is watched now
        for limit in limits:
            if limit is not None:
                limit.flight = None
        raise


class Deadlines:
    """Every limit that is watched.

    Most flights end long before their limits, and nearly all limits of an app are equally long:
    those expire in the order in which they began. So there is a queue for each length, and one
    timer a queue instead of one a flight.
    """

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._queues: dict[float, deque[Limit]] = {}
        self._armed: set[float] = set()

    def watch(self, limit: Limit) -> None:
        """Expire a limit at its time, unless it is idle by then."""
        kernel, span = self._kernel, limit.span
        if limit.since != kernel.now:  # it began before: it may expire before those that wait
            kernel.at(limit.since + span, Kind.TIMER, limit.key, limit.expire)
            return
        queue = self._queues.get(span)
        if queue is None:
            queue = self._queues[span] = deque()
        while queue and queue[0].idle:
            queue.popleft()
        queue.append(limit)
        if span not in self._armed:
            self._arm(span)

    def _arm(self, span: float) -> None:
        self._armed.add(span)
        until = self._queues[span][0].since + span
        self._kernel.at(until, Kind.TIMER, (), lambda: self._due(span))

    def _due(self, span: float) -> None:
        """Expire what is due, each in its own place among the events of this instant."""
        kernel, queue = self._kernel, self._queues[span]
        self._armed.remove(span)
        while queue and (queue[0].idle or queue[0].since + span <= kernel.now):
            limit = queue.popleft()
            kernel.at(limit.since + span, Kind.TIMER, limit.key, limit.expire)
        if queue:
            self._arm(span)
        else:
            del self._queues[span]
