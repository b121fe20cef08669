"""What the runtime remembers of a mission while it lives, beside what its user sees."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .status import Status, TripStatus

if TYPE_CHECKING:
    from .core import Core
    from .flight import Flight
    from .kernel import Task
    from .model import Drone, Item, Mission

HOOKS_AT_ONCE = 100_000
"""No graph has so many blocks in a row: a mission that calls so many hooks is in a loop."""


class State:
    """One living mission."""

    __slots__ = (
        "allocated",
        "at",
        "carrier",
        "carries",
        "core",
        "delay",
        "doom",
        "ending",
        "first_start",
        "flight",
        "goes_on",
        "hooked_at",
        "hooks",
        "interrupted",
        "last_action_end",
        "mission",
        "task",
        "waited",
        "waiting",
    )

    def __init__(
        self,
        core: Core,
        mission: Mission[Any],
        ending: Callable[[State], None],
        waiting: Callable[[State], None],
    ) -> None:
        self.core, self.mission = core, mission
        self.ending = ending
        """Told once when the mission is doomed."""
        self.waiting = waiting
        """Told when it must leave its graph, until a person says how it goes on."""
        self.interrupted = False
        """A flight of it was interrupted and does not count."""
        self.task: Task[Status] | None = None
        """The coroutine that takes it through its graph."""
        self.at: str | None = None
        """The last block it has met at which it can go on when it is interrupted."""
        self.goes_on = False
        """It was interrupted after a launch: until it is back there, it is given no drone."""
        self.delay: tuple[tuple[str, str, int, int], float, float] | None = None
        """(block, trip, round, attempt) where it waits, when its delay is over, and its round begins."""
        self.allocated: Drone | None = None
        """The drone that waits to be launched."""
        self.flight: Flight | None = None
        """The flight that was launched last."""
        self.carries: Item | None = None
        """The item aboard `carrier`, from `pick_item` to `release_item`."""
        self.carrier: Drone | None = None
        """The drone that the mission keeps while it carries an item."""
        self.first_start: float | None = None
        """When its first trip was let go."""
        self.last_action_end: float | None = None
        """When its previous action in this round was done."""
        self.waited: set[tuple[str, str, int, int]] | None = None
        """(block, trip, round, attempt) of every delay that is over."""
        self.doom: str | None = None
        """Why it must end whatever its graph says: a failure that no retry can mend."""
        self.hooked_at = 0.0
        """When its last hook was called."""
        self.hooks = 0
        """How many were called at that instant."""

    def wait_for_a_person(self) -> None:
        """Take it out of its graph until a person has said how it goes on."""
        self.waiting(self)

    def end(self, reason: str) -> None:
        """Take it out of its graph, FAILED; only the first reason counts."""
        if self.doom is None:
            self.doom = reason
            self.ending(self)

    def goes_round(self, now: float) -> bool:
        """Count a call of a hook; say whether the mission goes round and round without time."""
        if now != self.hooked_at:
            self.hooked_at, self.hooks = now, 0
        self.hooks += 1
        return self.hooks > HOOKS_AT_ONCE

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is TripStatus.EXECUTING else None
