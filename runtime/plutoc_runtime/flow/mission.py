"""What the runtime remembers of a mission while it lives, beside what its user sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..domain.status import Status, TripStatus

if TYPE_CHECKING:
    from ..domain.model import Drone, Item, Mission
    from ..time.kernel import Task
    from ..trips.flight import Flight
    from .core import Core
    from .engine import Engine

Place = tuple[str, str, int, int]
"""A delay: block, trip, round, attempt."""

MOST_CALLS = 100_000
"""Between two launches: a mission that calls its hooks so often is in a loop that it never leaves,
whether they answer at once or sleep in between."""


@dataclass(slots=True, eq=False)
class State:
    """One living mission."""

    core: Core
    mission: Mission[Any]
    engine: Engine
    """Who sees it to its end."""
    task: Task[Status] | None = None
    """The coroutine that takes it through its graph."""
    at: str | None = None
    """The last block it has met at which it can go on when it is interrupted."""
    goes_on: bool = False
    """It was interrupted after a launch: until it is back there, it is given no drone."""
    interrupted: bool = False
    """A flight of it was interrupted and does not count."""
    allocated: Drone | None = None
    """The drone that waits to be launched."""
    flight: Flight | None = None
    """The flight that was launched last."""
    carrier: Drone | None = None
    """The drone that the mission keeps while it carries an item."""
    carries: Item | None = None
    """The item aboard `carrier`, from `pick_item` to `release_item`."""
    last_action_end: float | None = None
    """When its previous action in this round was done."""
    calls: int = 0
    """How often its hooks were called since its last launch."""
    delay: tuple[Place, float, float] | None = None
    """Where it waits, when its delay is over, and its round begins."""
    waited: set[Place] | None = None
    """Every delay that is over."""
    first_start: float | None = None
    """When its first trip was let go."""
    doom: str | None = None
    """Why it must end whatever its graph says: a failure that no retry can mend."""

    def __call__(self, task: Task[Status]) -> None:
        """Hear that its coroutine is over."""
        self.engine.ended(self, task)

    def end(self, reason: str) -> None:
        """Take it out of its graph, FAILED; only the first reason counts."""
        if self.doom is None:
            self.doom = reason
            self.engine.doomed(self)

    def goes_round(self) -> bool:
        """Count a call of a hook; say whether the mission goes round and round without a launch."""
        self.calls += 1
        return self.calls > MOST_CALLS

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is TripStatus.EXECUTING else None
