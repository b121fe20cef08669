"""Where one mission stands, as small values that can be compared and remembered.

Tuples with names, for they are hashed by the million.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

from tests.soundness.kinds import Status


class Branch(NamedTuple):
    """A branch of an open fork."""

    block: str
    """Where the fork opened, and the status that forked."""
    status: Status
    place: int
    width: int


Stack = tuple[Branch, ...]
"""The branches that a clone is in, the innermost last: with it, the number of each fork."""


class Token(NamedTuple):
    """The mission, or one of its clones, in a block."""

    block: str
    status: Status
    stack: Stack
    phase: str = "in"
    """`in` a block, `at` a gate, or one that `waits` there for the other branches."""


class State(NamedTuple):
    """A mission between two steps."""

    tokens: tuple[Token, ...]
    """Sorted: which clone is which does not matter."""
    trips: int
    flown: int
    """How often the first trip has been flown."""
    drone: bool
    """Allocated since the previous launch."""
    flight: Status | None
    """RUNNING, or how the last flight ended; None before the first launch."""
    said: tuple[tuple[str, Status], ...] = ()
    """What repeaters and evaluators have said since the last launch: asked again, they say the same."""
    given_up: int = 0
    """The most flights after which a retry gave the first trip up, since the last launch: asked now,
    each retry that gives up after as many, or fewer, does so."""
    spent: bool = False
    """An evaluator has failed it, so that no trip is left; a modifier's hook may have put one back."""
    before: int = 0
    """How often the trip in flight had been flown before, where an event may break it off."""

    @property
    def idle(self) -> bool:
        """Return whether nothing is left to fly, and nothing flies."""
        return not self.trips and self.flight not in (None, Status.RUNNING)


class Verdict(StrEnum):
    """What a run shows to be wrong."""

    STUCK = "stuck"
    DEADLOCKED = "deadlocked"
    FLOWN_TWICE = "flown twice"
    LOST = "lost clone"
    NO_DRONE = "launch without a drone"
    NO_LAUNCH = "monitor without a launch"
    ENDLESS = "never ends"
    BREEDS = "clones multiply"
    UNCLOSED = "branch never closes"
    """No run need show it: the gate lets another branch pass, and calls this one off."""


class Wrong(Exception):
    """A run cannot go on."""

    def __init__(self, verdict: Verdict, where: str) -> None:
        super().__init__(f"{verdict} at {where}")
        self.verdict = verdict
