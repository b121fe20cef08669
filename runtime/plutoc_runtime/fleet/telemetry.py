"""What is known of the drones: told as motion, so that it is exact at any instant between two messages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import dist, inf
from typing import TYPE_CHECKING, Any

from ..domain.motion import charged, smoothly

if TYPE_CHECKING:
    from ..domain.model import Point
    from ..domain.motion import Motion
    from ..domain.trace import Clock


MOMENT = 0.001
"""Seconds by which sums of floats may be off, and more."""


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight way between two points, with the times at its ends; `smooth`: at rest there."""

    start: Point
    end: Point
    leaves: float
    arrives: float
    smooth: bool = False

    def at(self, now: float) -> Point:
        """Return the position at a time; before and after the leg, nothing moves.

        A leg of no duration may be asked for a moment before it: sums of floats are not exact.
        """
        if now >= self.arrives or self.arrives <= self.leaves:
            return self.end
        if now <= self.leaves:
            return self.start
        part = (now - self.leaves) / (self.arrives - self.leaves)
        part = smoothly(part) if self.smooth else part
        x, y, z = self.start
        end_x, end_y, end_z = self.end
        return x + part * (end_x - x), y + part * (end_y - y), z + part * (end_z - z)

    def velocity(self, now: float) -> Point:
        """Return the metres per second at a time."""
        then = now - MOMENT
        x, y, z = ((b - a) / MOMENT for a, b in zip(self.at(then), self.at(now), strict=True))
        return x, y, z

    def length(self, now: float) -> float:
        """Return the metres flown at a time."""
        return dist(self.start, self.at(now))


def resting(place: Point, now: float) -> Leg:
    """Return a leg that stays in one place."""
    return Leg(place, place, now, now)


def place_on(legs: Sequence[Leg], now: float) -> Point:
    """Return the place at a time on legs that are flown one after the other."""
    for leg in legs:
        if now < leg.arrives:
            return leg.at(now)
    return legs[-1].end


@dataclass(frozen=True, slots=True)
class Charge:
    """A battery: its level at a time, from 0 to 1, its change per second, and where a charge slows."""

    level: float
    since: float
    rate: float = 0.0
    taper: float = 0.0

    def at(self, now: float) -> float:
        """Return the level at a time."""
        if not self.rate or now <= self.since:
            return self.level
        if self.rate > 0.0 and self.taper:
            return charged(self.level, now - self.since, 1.0 / self.rate, self.taper)
        level = self.level + self.rate * (now - self.since)
        return min(1.0, level) if level > 0.0 else 0.0

    @property
    def empty_at(self) -> float:
        """When it will be empty; infinite: never."""
        return self.since - self.level / self.rate if self.rate < 0 else inf

    def changing(self, now: float, rate: float) -> Charge:
        """Return the battery with another rate from now on."""
        return Charge(self.at(now), now, rate, self.taper)


class KnownState:
    """The state of one drone, as it was told last: the drone's `Telemetry`. Hooks see it, and change nothing of it."""

    __slots__ = ("_charge", "_clock", "_landed", "_legs", "_motion")

    def __init__(self, clock: Clock, home: Point, motion: Motion) -> None:
        self._motion = motion
        self._landed = True
        self._clock = clock
        self._legs = [resting(home, 0.0)]
        self._charge = Charge(0.0, 0.0)

    @property
    def motion(self) -> Motion:
        """How it moves."""
        return self._motion

    @property
    def location(self) -> Point:
        """Where it is."""
        last = self._legs[-1]
        now = self._clock.now
        return last.end if now >= last.arrives else place_on(self._legs, now)

    @property
    def battery_level(self) -> float:
        """The charge of its battery, from 0 to 1."""
        charge = self._charge
        return charge.at(self._clock.now) if charge.rate else charge.level

    @property
    def landed(self) -> bool:
        """Whether it stands on the ground."""
        return self._landed

    def take(self, told: Mapping[str, Any]) -> None:
        """Take over a message about it; what the message does not say stays as it was."""
        now = self._clock.now
        if legs := told.get("legs"):
            smooth = self._motion.smooth
            self._legs = [
                Leg((ax, ay, az), (bx, by, bz), leaves, arrives, smooth)
                for (ax, ay, az), (bx, by, bz), leaves, arrives in legs
            ]
        elif "at" in told:
            x, y, z = told["at"]
            self._legs = [resting((x, y, z), now)]
        match told.get("battery"):
            case [level, since, rate]:
                self._charge = Charge(level, since, rate, self._motion.taper)
            case float(level) | int(level):
                self._charge = Charge(level, now)
        self._landed = told.get("landed", self._landed)
