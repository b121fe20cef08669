"""The motion of a simulated multicopter: what its autopilot's position controller makes of a target.

Metres east, north and up of where it was switched on. Level and upright motion are controlled apart, as both autopilots
do: each approaches its goal no faster than its limit, and than it can still brake.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import copysign, hypot, sqrt

Metres = tuple[float, float, float]

_GAIN = 2.0
"""Of the position controller, per second: near its goal a vehicle approaches it as an exponential does."""
_THERE = 0.01
"""Metres and metres per second within which it stands still."""
_GRAVITY = 9.81
_FASTEST_FALL = 20.0


@dataclass(slots=True)
class Limits:
    """How fast it may fly: metres per second, and per second squared."""

    level: float
    up: float
    down: float
    level_acceleration: float
    upright_acceleration: float


@dataclass(slots=True)
class Body:
    """Where it is, and how it moves."""

    limits: Limits
    at: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    goal: Metres = (0.0, 0.0, 0.0)
    heading: float = 0.0
    """The direction in which it last flew, in radians, clockwise from north."""

    @property
    def speed(self) -> float:
        return hypot(*self.velocity)

    @property
    def stopping_place(self) -> Metres:
        """Where it comes to rest if it brakes now."""
        east, north, up = self.velocity
        level = hypot(east, north)
        way = level / (2 * self.limits.level_acceleration)
        rise = up * abs(up) / (2 * self.limits.upright_acceleration)
        x, y, z = self.at
        return x + east * way, y + north * way, max(0.0, z + rise)

    def fly(self, seconds: float) -> None:
        """Approach the goal for so long."""
        limits = self.limits
        away = [goal - at for goal, at in zip(self.goal, self.at, strict=True)]
        wanted = _towards(away[:2], limits.level, limits.level_acceleration)
        _accelerate(self.velocity, wanted, limits.level_acceleration * seconds)
        most = limits.up if away[2] > 0 else limits.down
        climb = _towards(away[2:], most, limits.upright_acceleration)
        self.velocity[2] += _within(
            climb[0] - self.velocity[2], limits.upright_acceleration * seconds
        )
        self._move(seconds)

    def fall(self, seconds: float) -> None:
        """Fall, as without motors."""
        self.velocity[2] = max(-_FASTEST_FALL, self.velocity[2] - _GRAVITY * seconds)
        self._move(seconds)

    def _move(self, seconds: float) -> None:
        for axis, speed in enumerate(self.velocity):
            self.at[axis] += speed * seconds
        if self.at[2] <= 0.0:
            self.at[2] = 0.0
            self.velocity[:] = [0.0, 0.0, 0.0]


def _towards(away: Sequence[float], most: float, acceleration: float) -> list[float]:
    """Return the velocity at which to approach a goal so far away."""
    distance = hypot(*away)
    if distance < _THERE:
        return [0.0] * len(away)
    speed = min(most, _GAIN * distance, sqrt(2 * acceleration * distance))
    return [speed * part / distance for part in away]


def _accelerate(velocity: list[float], wanted: Sequence[float], most: float) -> None:
    """Change the level velocity by no more than so much."""
    change = [one - other for one, other in zip(wanted, velocity, strict=False)]
    size = hypot(*change)
    share = 1.0 if size <= most else most / size
    for axis, part in enumerate(change):
        velocity[axis] += share * part


def _within(value: float, most: float) -> float:
    return copysign(min(abs(value), most), value)
