"""One trip's flight by one drone: what is ordered, its outcome, and how long it may take."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, Any

from ..domain.status import FAILED, Status
from ..hooks.plain_data import item_data
from ..time.kernel import EventKind, Future, Kernel, Timer

if TYPE_CHECKING:
    from ..domain.actions import Action
    from ..domain.model import Drone, Mission, Point, Trip
    from ..time.kernel import Key, Task


@dataclass(slots=True, eq=False)
class Flight(Future[Status]):
    """As a future it is set to the mission's status when the trip has ended."""

    mission: Mission[Any]
    trip: Trip
    flier: Drone
    action: Action
    launched_at: float
    retry: bool
    """Whether the mission's previous flight was of the same trip, and failed."""
    own_action: Task[None] | None = None
    """The task of an action of the app's own, once it has begun."""
    called_off: str | None = None
    """None: it flies; empty: it was broken off; else why it fails once its drone has answered."""
    begun: bool = False
    """Whether an action of the app's own has begun: from then on it may have been done."""
    beside: Point | None = None
    """Where the action is done, if that is not at the trip's target."""
    relieved: int = 0
    """How often another drone has taken over."""
    company: tuple[Task[Any], ...] = ()
    """What goes on beside it, and ends with it."""
    heard: bool = False
    """Whether the mission's graph has gone on from its end."""
    round: int = field(init=False)
    attempt: int = field(init=False)

    def __post_init__(self) -> None:
        Future.__init__(self)
        self.round = self.mission.round
        self.attempt = self.trip.attempt

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

    def end_company(self) -> None:
        """End what goes on beside it."""
        for task in self.company:
            task.cancel()

    @property
    def failed(self) -> bool:
        """Whether it has ended, and failed."""
        return self._value is FAILED


class Limit:
    """How long a trip may take, from when on, and the reason that is given if it takes longer."""

    __slots__ = ("abort", "branch", "flight", "key", "overdue", "span", "until")

    flight: Flight
    """What it is set for."""
    branch: Task[Any] | None
    """The coroutine that has set it: it is void once that has ended."""
    key: Key
    abort: Callable[[str], None]

    def __init__(self, since: float, span: float, overdue: Callable[[Trip, float], str]) -> None:
        self.span = span
        self.until = since + span
        self.overdue = overdue

    @property
    def is_void(self) -> bool:
        """Whether the flight has ended, or the branch that set it."""
        return self.flight.is_set or (self.branch is not None and self.branch.is_set)

    def expire(self) -> None:
        """Fail the trip in flight, unless that is over."""
        if not self.is_void:
            self.abort(self.overdue(self.flight.trip, self.span))


class Limits:
    """The limits on flights: as most end long before, one timer serves all."""

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self._set: dict[tuple[Task[Any] | None, Key], Limit] = {}
        """By branch, which waits for one flight at a time."""
        self._due: Timer | None = None
        self._due_at = inf

    def add(self, limit: Limit) -> None:
        """Fail its flight at a limit, unless that or the branch has ended by then."""
        self._set[limit.branch, limit.key] = limit
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
        limits = [limit for limit in self._set.values() if not limit.is_void]
        self._set = {(one.branch, one.key): one for one in limits if one.until > now}
        for limit in limits:
            if not limit.until > now:
                # after a hook of the mission at that instant, as if it were in a branch of its own
                self._kernel.at(now, EventKind.TIMER, limit.key, limit.expire)
        self._due_at = inf
        if self._set:
            self._wait(min(limit.until for limit in self._set.values()))
