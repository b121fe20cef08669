"""One trip's flight by one drone: what is ordered, and its outcome."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..domain.status import FAILED, Status
from ..hooks.plain_data import item_data
from ..time.future import Future

if TYPE_CHECKING:
    from ..domain.actions import Action
    from ..domain.model import Drone, Mission, Trip
    from ..time.kernel import Task


class Flight(Future[Status]):
    """As a future it is set to the mission's status when the trip has ended."""

    __slots__ = (
        "_action",
        "called_off",
        "flier",
        "hook",
        "launched_at",
        "mission",
        "overdue",
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
    ) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.mission, self.trip, self.flier, self._action = mission, trip, flier, action
        self.hook = action.hook
        """The hook of an action of the app's own; None: a built-in action."""
        self.launched_at = launched_at
        self.retry = retry
        """The mission's previous flight was of the same trip, and failed."""
        self.own_action: Task[None] | None = None
        """The task of an action of the app's own, once it has begun."""
        self.called_off = False
        """It was aborted."""
        self.overdue = ""
        """Why it was aborted, while its drone is asked what it has done."""

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: a flight has the same id in every run."""
        mission, trip = self.mission, self.trip
        return f"{mission.name}/{trip.name}/{mission.round}/{trip.attempt}"

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
        source, item = trip.source, trip.item
        return {
            "do": "fly",
            "drone": self.flier.id,
            "flight": self.id,
            "stops": (trip.target,) if source is None else (source, trip.target),
            "action": trip.action if self.hook is None else None,
            "parameters": trip.parameters,
            "item": None if item is None else item_data(item),
            "seconds": self._action.seconds,
        }

    @property
    def failed(self) -> bool:
        """Whether it has ended, and failed."""
        return self._value is FAILED
