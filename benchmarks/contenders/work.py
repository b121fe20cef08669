"""What every contender does, and what must come of it.

Missions of so many trips, flown one after the other, share so many drones. A flight fails by a pure
hash of (mission, trip, attempt), so what must come of it does not depend on who flies when.

    start -> create -> allocate -> launch -> [watch, timer] -> first
    first -> allocate when STANDBY                   the trip is done, and more are left
    first -> retry -> allocate when FAILED           one priority higher
    first -> judge -> again -> end when COMPLETED    accepted, and not repeated

A timer of 30 s watches each flight, and always comes too late. The free drone that is lowest in the
fleet flies for the mission of the highest priority; of equals, for the one that waits longest.
"""

from __future__ import annotations

from dataclasses import dataclass

LIMIT = 30.0
"""Seconds after which a flight would be given up."""
FAILING = int(0.05 * 2**32)
"""Of 2³² flights, so many fail."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Work:
    """So much is to be flown."""

    missions: int = 400
    trips: int = 5
    """Of each mission."""
    drones: int = 40
    flight: float = 0.0
    """Seconds. None at all: what is measured is the system, not the air."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """What came of it."""

    missions: int
    """Completed."""
    completed: int
    """Trips."""
    failed: int
    """Flights."""

    @property
    def flights(self) -> int:
        """How many flights it took."""
        return self.completed + self.failed


def fails(mission: int, trip: int, attempt: int) -> bool:
    """Return whether this flight fails; all three count from 0."""
    x = (mission * 1000003 + trip * 10007 + attempt * 101 + 12345) & 0xFFFFFFFF
    x ^= x >> 16
    x = (x * 0x45D9F3B) & 0xFFFFFFFF
    x ^= x >> 16
    x = (x * 0x45D9F3B) & 0xFFFFFFFF
    x ^= x >> 16
    return x < FAILING


def expected(work: Work) -> Done:
    """Return what every contender must come to."""
    failed = 0
    for mission in range(work.missions):
        for trip in range(work.trips):
            attempt = 0
            while fails(mission, trip, attempt):
                failed += 1
                attempt += 1
    return Done(missions=work.missions, completed=work.missions * work.trips, failed=failed)
