"""What changes evenly, kept as its last change: a drone's place and its battery's level."""

from __future__ import annotations

from dataclasses import dataclass
from math import dist, inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..domain.model import Point


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight way from one place, left at a time, to another, reached at a time."""

    start: Point
    end: Point
    leaves: float
    arrives: float

    def at(self, now: float) -> Point:
        """Return the place at a time; before and after it, nothing moves.

        A leg of no duration may be asked for a moment before it: sums of floats are not exact.
        """
        if now >= self.arrives or self.arrives <= self.leaves:
            return self.end
        if now <= self.leaves:
            return self.start
        part = (now - self.leaves) / (self.arrives - self.leaves)
        (ax, ay, az), (bx, by, bz) = self.start, self.end
        return ax + part * (bx - ax), ay + part * (by - ay), az + part * (bz - az)

    def length(self, now: float) -> float:
        """Return how many metres of it are behind at a time."""
        return dist(self.start, self.at(now))


def standing(place: Point, now: float) -> Leg:
    """Return the leg of who goes nowhere."""
    return Leg(place, place, now, now)


@dataclass(frozen=True, slots=True)
class Charge:
    """A battery: what was in it at a time, from 0 to 1, and how that changes each second."""

    level: float
    since: float
    rate: float = 0.0

    def at(self, now: float) -> float:
        """Return the level at a time."""
        if not self.rate or now <= self.since:
            return self.level
        level = self.level + self.rate * (now - self.since)
        return min(1.0, level) if level > 0.0 else 0.0

    @property
    def empty_at(self) -> float:
        """When nothing is left; infinite if that never comes."""
        return self.since - self.level / self.rate if self.rate < 0 else inf

    def changing(self, now: float, rate: float) -> Charge:
        """Return the battery that changes otherwise from now on."""
        return Charge(self.at(now), now, rate)
