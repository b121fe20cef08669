"""What the runtime remembers of a mission while it lives, beside what its user sees."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .status import Status, TripStatus

if TYPE_CHECKING:
    from .flight import Flight
    from .kernel import Task
    from .model import Drone, Item, Mission

HOOKS_AT_ONCE = 100_000
"""No graph has so many blocks in a row: a mission that calls so many hooks is in a loop."""


@dataclass(slots=True, kw_only=True, eq=False)
class State:
    """One living mission."""

    mission: Mission[Any]
    ending: Callable[[State], None]
    """Told once when the mission is doomed."""
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
    waited: set[tuple[str, str, int, int]] | None = None
    """(block, trip, round, attempt) of every delay that is over."""
    doom: str | None = None
    """Why it must end whatever its graph says: a failure that no retry can mend."""
    hooks_at: tuple[float, int] = (0.0, 0)
    """When its last hook was called, and how many were at that instant."""

    def end(self, reason: str) -> None:
        """Take it out of its graph, FAILED; only the first reason counts."""
        if self.doom is None:
            self.doom = reason
            self.ending(self)

    def goes_round(self, now: float) -> bool:
        """Count a call of a hook; say whether the mission goes round and round without time."""
        when, count = self.hooks_at
        self.hooks_at = (now, count + 1 if now == when else 1)
        return self.hooks_at[1] > HOOKS_AT_ONCE

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is TripStatus.EXECUTING else None
