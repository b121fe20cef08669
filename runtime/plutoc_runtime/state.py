"""What the runtime remembers of a mission while it lives, beside what its user sees."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .kernel import Signal, Task
from .status import Status, TripStatus

if TYPE_CHECKING:
    from .model import Drone, Item, Mission, Trip

HOOKS_AT_ONCE = 100_000
"""No graph has so many blocks in a row: a mission that calls so many hooks is in a loop."""


@dataclass(slots=True, kw_only=True, eq=False)
class Flight:
    """One trip's flight by one drone."""

    trip: Trip
    drone: Drone
    launched_at: float
    retry: bool
    """The mission's flight before this one was of the same trip, and failed."""
    ended: Signal[Status] = field(default_factory=Signal)
    """How the mission stood when the trip was over."""
    task: Task[None] | None = None
    succeeded: bool = False


@dataclass(slots=True, kw_only=True, eq=False)
class State:
    """One living mission."""

    mission: Mission[Any]
    task: Task[Status] | None = None
    """The coroutine that takes it through its graph."""
    allocated: Drone | None = None
    """The drone that waits to be launched."""
    flight: Flight | None = None
    """The flight that was launched last."""
    carries: Item | None = None
    """The item aboard `carrier`, from `pick_item` to `release_item`."""
    carrier: Drone | None = None
    """The drone that the mission keeps while it carries an item."""
    first_start: float | None = None
    """When its first trip was let go."""
    last_action_end: float | None = None
    """When its previous action in this round was done."""
    waited: set[tuple[str, str, int, int]] = field(default_factory=set)
    """(block, trip, round, attempt) of every delay that is over."""
    doom: Signal[str] = field(default_factory=Signal)
    """Set, with the reason, by a failure that no retry can mend."""
    hooks_at: tuple[float, int] = (0.0, 0)
    """When its last hook was called, and how many were at that instant."""

    def goes_round(self, now: float) -> bool:
        """Count a call of a hook; say whether the mission goes round and round without time."""
        when, count = self.hooks_at
        self.hooks_at = (now, count + 1 if now == when else 1)
        return self.hooks_at[1] > HOOKS_AT_ONCE

    def begin_flight(self, drone: Drone, now: float) -> Flight:
        """The allocated drone leaves for the next trip."""
        trip, last = self.mission.current, self.flight
        retry = last is not None and last.trip is trip and not last.succeeded
        self.flight = Flight(trip=trip, drone=drone, launched_at=now, retry=retry)
        self.allocated = None
        return self.flight

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is TripStatus.EXECUTING else None
