"""The motion of a simulated multicopter: what its autopilot makes of a target, with a limited jerk, and in the wind.

Metres east, north and up of where it was switched on. Level and upright motion are shaped apart, as both autopilots
do: how fast a goal is approached from afar, and how a velocity is changed to another, is each make's own way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import hypot, inf, sqrt

Metres = tuple[float, float, float]

_THERE = 0.01
"""Metres within which it stands still."""
_GRAVITY = 9.81
_FASTEST_FALL = 20.0
_HALVINGS = 20
"""Of the speed at which it makes headway against the wind."""


def root(error: float, gain: float, most: float) -> float:
    """Return the rate at which an error is made up for: in proportion to it, and slowing down by `most` from afar.

    ArduPilot's `sqrt_controller` (libraries/AP_Math/control.cpp).
    """
    even = most / gain**2
    return gain * error if error <= even else sqrt(2 * most * (error - even / 2))


@dataclass(slots=True)
class Limits:
    """How it may fly: metres per second, per second squared, and per second cubed."""

    level: float
    up: float
    down: float
    level_acceleration: float
    up_acceleration: float
    down_acceleration: float
    jerk: float
    approach: Callable[[float, float, float], float]
    """Returns how fast it may be at a distance from its goal, with an acceleration and a jerk."""
    gain: Callable[[float, float], float]
    """Returns the acceleration for each metre per second that it is too slow or too fast, with the same two."""
    airspeed: float
    """Through the air, at most: what its greatest tilt gives."""


@dataclass(slots=True)
class Body:
    """Where it is, and how it moves."""

    limits: Limits
    at: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    goal: Metres = (0.0, 0.0, 0.0)
    heading: float = 0.0
    """The direction in which it last flew, in radians, clockwise from north."""
    wind: tuple[float, float] = (0.0, 0.0)
    """To where the air moves, in metres a second east and north."""
    _acceleration: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])

    @property
    def speed(self) -> float:
        return hypot(*self.velocity)

    @property
    def airspeed(self) -> float:
        """How fast it flies through the air, on the level."""
        return _apart(self.velocity, self.wind)

    @property
    def stopping_place(self) -> Metres:
        """Where it comes to rest if it brakes now: PX4's `computeBrakingDistanceFromVelocity` (TrajMath.hpp)."""
        limits = self.limits
        east, north, up = self.velocity
        level = limits.level_acceleration
        way = hypot(east, north) / (2 * level) + level / limits.jerk
        upright = limits.up_acceleration if up > 0 else limits.down_acceleration
        rise = up * (abs(up) / (2 * upright) + upright / limits.jerk)
        x, y, z = self.at
        return x + east * way, y + north * way, max(0.0, z + rise)

    def fly(self, seconds: float) -> None:
        """Approach the goal for so long."""
        limits = self.limits
        x, y, z = (goal - at for goal, at in zip(self.goal, self.at, strict=True))
        wanted = self._towards([x, y], limits.level, limits.level_acceleration)
        if any(self.wind):
            wanted = _headway(wanted, self.wind, limits.airspeed)
        self._change(slice(0, 2), wanted, limits.level_acceleration, seconds)
        rises = z > 0
        upright = limits.up_acceleration if rises else limits.down_acceleration
        climb = self._towards([z], limits.up if rises else limits.down, upright)
        self._change(slice(2, 3), climb, upright, seconds)
        self._move(seconds)

    def fall(self, seconds: float) -> None:
        """Fall, as without motors."""
        self.velocity[2] = max(-_FASTEST_FALL, self.velocity[2] - _GRAVITY * seconds)
        self._move(seconds)

    def _towards(self, away: Sequence[float], most: float, acceleration: float) -> list[float]:
        """Return the velocity at which to approach a goal so far away."""
        distance = hypot(*away)
        if distance < _THERE:
            return [0.0] * len(away)
        speed = min(most, self.limits.approach(distance, acceleration, self.limits.jerk))
        return [speed * part / distance for part in away]

    def _change(
        self, axes: slice, wanted: Sequence[float], acceleration: float, seconds: float
    ) -> None:
        """Bring the velocity along some axes nearer to a wanted one."""
        jerk = self.limits.jerk
        velocity = self.velocity[axes]
        error = [one - other for one, other in zip(wanted, velocity, strict=True)]
        size = hypot(*error)
        most = min(acceleration, root(size, self.limits.gain(acceleration, jerk), jerk))
        now = self._acceleration[axes]
        then = [most * one / size if size else 0.0 for one in error]
        change = _apart(then, now)
        share = min(1.0, jerk * seconds / change) if change else 0.0
        now = [one + share * (other - one) for one, other in zip(now, then, strict=True)]
        self._acceleration[axes] = now
        self.velocity[axes] = [v + a * seconds for v, a in zip(velocity, now, strict=True)]

    def _move(self, seconds: float) -> None:
        for axis, speed in enumerate(self.velocity):
            self.at[axis] += speed * seconds
        if self.at[2] <= 0.0:
            self.at[2] = 0.0
            self.velocity[:] = [0.0, 0.0, 0.0]
            self._acceleration[:] = [0.0, 0.0, 0.0]


def _apart(one: Sequence[float], other: Sequence[float]) -> float:
    return hypot(*(a - b for a, b in zip(one, other, strict=False)))


def _headway(wanted: Sequence[float], wind: Sequence[float], most: float) -> list[float]:
    """Return the velocity over ground that comes nearest to a wanted one, no faster than `most` through the air.

    It slows down on its way; where it cannot even hover, it is blown away.
    """
    if _apart(wanted, wind) <= most:
        return list(wanted)
    if hypot(*wind) >= most:
        share = most / (_apart(wanted, wind) or inf)
        return [w + share * (one - w) for one, w in zip(wanted, wind, strict=True)]
    slow, fast = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (slow + fast) / 2
        if _apart([middle * one for one in wanted], wind) <= most:
            slow = middle
        else:
            fast = middle
    return [slow * one for one in wanted]
