"""One trip's flight by one drone: what is ordered, its outcome, and how long it may take."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.status import FAILED, Status
from ..hooks.plain_data import item_data
from ..time.kernel import EventKind, Future, Kernel, Timer

if TYPE_CHECKING:
    from ..domain.actions import Action
    from ..domain.model import Drone, Mission, Point, Trip
    from ..time.kernel import Key, Task


class Flight(Future[Status]):
    """As a future it is set to the mission's status when the trip has ended."""

    __slots__ = (
        "action",
        "attempt",
        "begun",
        "beside",
        "called_off",
        "flier",
        "heard",
        "launched_at",
        "mission",
        "own_action",
        "relieved",
        "retry",
        "round",
        "trip",
    )

    def __init__(
        self,
        mission: Mission[Any],
        trip: Trip,
        flier: Drone,
        action: Action,
        launched_at: float,
        retry: bool,
    ) -> None:
        super().__init__()
        self.mission = mission
        self.trip = trip
        self.flier = flier
        self.action = action
        self.launched_at = launched_at
        self.retry = retry  # the mission's previous flight was of the same trip, and failed
        self.round = mission.round
        self.attempt = trip.attempt
        self.own_action: Task[None] | None = None
        """The task of an action of the app's own, once it has begun."""
        self.called_off: str | None = None
        """None: it flies; empty: it was broken off; else why it fails once its drone has answered."""
        self.begun = False
        """Whether an action of the app's own has begun: from then on it may have been done."""
        self.beside: Point | None = None
        """Where the action is done, if that is not at the trip's target."""
        self.relieved = 0  # how often another drone has taken over
        self.heard = False
        """Whether the mission's graph has gone on from its end."""

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: a flight has the same id in every run."""
        again = f"+{self.relieved}" if self.relieved else ""
        return f"{self.mission.name}/{self.trip.name}/{self.round}/{self.attempt}{again}"

    @property
    def drone(self) -> str:
        """The id of the drone that flies."""
        return self.flier.id

    @property
    def order(self) -> dict[str, object]:
        """What is ordered: the stops in order, and the action at the last one.

        Without an action it hovers there, for one of the app's own.
        """
        trip = self.trip
        action = self.action
        source = trip.source
        item = trip.item
        return {
            "do": "fly",
            "drone": self.flier.id,
            "flight": self.id,
            "stops": (trip.target,) if source is None else (source, trip.target),
            "action": trip.action if action.hook is None else None,
            "parameters": {**trip.parameters},
            "item": None if item is None else item_data(item),
            "seconds": action.lasts(trip.parameters),
            "beside": action.repeat == "safe",
        }

    @property
    def failed(self) -> bool:
        """Whether it has ended, and failed."""
        return self._value is FAILED


class Branch(Protocol):
    """The branch of a mission that sets a limit; the limit is void once the branch has ended."""

    key: Key
    task: Task[Any] | None

    def abort(self, reason: str) -> None:
        """Fail the trip in flight."""


class Limit:
    """How long a trip may take, from when on, and the reason that is given if it takes longer."""

    __slots__ = ("flight", "overdue", "span", "until")

    flight: Flight  # the flight that it is set for

    def __init__(self, since: float, span: float, overdue: Callable[[Trip, float], str]) -> None:
        self.span = span
        self.until = since + span
        self.overdue = overdue

    def is_void(self, branch: Branch) -> bool:
        """Return whether the flight has ended, or the branch that set the limit."""
        return self.flight.is_set or (branch.task is not None and branch.task.is_set)

    def expire(self, branch: Branch) -> None:
        """Fail the trip in flight, unless that is over."""
        if not self.is_void(branch):
            branch.abort(self.overdue(self.flight.trip, self.span))


class Limits:
    """The limits on flights: as most end long before, one timer serves all."""

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._set: dict[tuple[Branch, int], Limit] = {}
        self._due: Timer | None = None
        self._due_at = inf

    def set(self, branch: Branch, number: int, flight: Flight, limit: Limit) -> None:
        """Fail the flight at this limit, unless it or the branch has ended by then.

        A branch waits for one flight at a time; `number` counts its limits on that.
        """
        limit.flight = flight
        self._set[branch, number] = limit
        if not limit.until >= self._due_at:  # what is not a number means now
            self._wait(limit.until)

    def _wait(self, until: float) -> None:
        if self._due is not None:
            self._due.cancel()
        self._due_at = until
        self._due = self._kernel.at(until, EventKind.TIMER, -1, self._look)

    def _look(self) -> None:
        """Expire what is due, and wait for the next."""
        now = self._kernel.now
        self._due_at = inf
        for (branch, number), limit in tuple(self._set.items()):
            if limit.is_void(branch) or not limit.until > now:
                del self._set[branch, number]
                # after a hook of the mission at that instant, as if it were in a branch of its own
                key = branch.key + number
                self._kernel.at(now, EventKind.TIMER, key, partial(limit.expire, branch))
            else:
                self._due_at = min(self._due_at, limit.until)
        if self._due_at < inf:
            self._wait(self._due_at)
