"""One trip's flight by one drone: what its navigation may ask of it, and how it tells its end."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..domain.status import FAILED, Status
from ..time.future import Future

if TYPE_CHECKING:
    from ..domain.actions import Action, Plain
    from ..domain.model import Drone, Item, Mission, Point, Trip
    from ..time.kernel import Task


class Flight(Future[Status]):
    """The job that navigation gets; it is set when the trip is over, to how the mission stands then."""

    __slots__ = (
        "_action",
        "_reported",
        "called_off",
        "flier",
        "hook",
        "launched_at",
        "mission",
        "own_action",
        "retry",
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
        reported: Callable[[Flight, object], None],
    ) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.mission, self.trip, self.flier, self._action = mission, trip, flier, action
        self.hook = action.hook
        """The action of the app's own; None: it is one of ours."""
        self.launched_at = launched_at
        self.retry = retry
        """The mission's flight before this one was of the same trip, and failed."""
        self._reported = reported
        """Told what navigation reports."""
        self.own_action: Task[None] | None = None
        """What does an action of the app's own, once it has begun."""
        self.called_off = False
        """It was broken off, and its drone is asked what it has done."""

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: the same flight has the same id in every run."""
        mission, trip = self.mission, self.trip
        return f"{mission.name}/{trip.name}/{mission.round}/{trip.attempt}"

    @property
    def drone(self) -> str:
        """The id of the drone that flies."""
        return self.flier.id

    @property
    def stops(self) -> tuple[Point, ...]:
        """Where to fly, in order."""
        source, target = self.trip.source, self.trip.target
        return (target,) if source is None else (source, target)

    @property
    def action(self) -> str | None:
        """What to do at the last stop; None: hover, for an action of the app's own."""
        return self.trip.action if self.hook is None else None

    @property
    def seconds(self) -> float:
        """How long the action is expected to take."""
        return self._action.seconds

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """How to do it."""
        return self.trip.parameters

    @property
    def item(self) -> Item | None:
        """What to pick or to release."""
        return self.trip.item

    @property
    def failed(self) -> bool:
        """Whether it is over and went wrong."""
        return self._value is FAILED

    def begins(self) -> None:
        """Hear that the action is about to be done."""

    def report(self, result: object) -> None:
        """Hear that the job is done and what it gave, or the `FlightFailed` that ended it."""
        self._reported(self, result)
