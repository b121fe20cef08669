"""The trajectories of the high-level commander: which one leads a drone on its way somewhere else, without a stop.

The firmware plans a polynomial of the 7th order from where its setpoint is, as fast as that moves, to rest at
the end. One that is too short, or too long for how fast the drone moves already, shoots far past its end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import dist, hypot
from typing import NamedTuple

from ..shared.domain.model import Point
from ..shared.domain.motion import MOST, SHORTEST

Limits = tuple[float, float, float]
"""Metres per second forward, sideways and up; infinite for a firmware without such limits."""
REST: Point = (0.0, 0.0, 0.0)


class Setpoint(NamedTuple):
    """Where a drone is told to be at a moment, how fast, and how that changes."""

    position: Point
    velocity: Point = REST
    acceleration: Point = REST


@dataclass(frozen=True, slots=True)
class Course:
    """One trajectory, as the firmware plans it."""

    start: Setpoint
    end: Point
    seconds: float

    def at(self, passed: float) -> Setpoint:
        """Return the setpoint after so many seconds; from its end on, it rests there."""
        if passed >= self.seconds:
            return Setpoint(self.end)
        axes = zip(*self.start, self.end, strict=True)
        (x, vx, ax), (y, vy, ay), (z, vz, az) = (
            _moved(*axis, self.seconds, max(0.0, passed) / self.seconds) for axis in axes
        )
        return Setpoint((x, y, z), (vx, vy, vz), (ax, ay, az))

    def keeps(self, limits: Limits, speed: float, pushes: float) -> bool:
        """Return whether it stays within speed limits, and within an acceleration."""
        across, sideways, up = limits
        for sample in range(1, _SAMPLES):
            _, (vx, vy, vz), acceleration = self.at(self.seconds * sample / _SAMPLES)
            if (
                hypot(vx, vy, vz) > speed
                or hypot(vx, vy) > min(across, sideways) * _EASED
                or abs(vz) > up * _EASED
                or hypot(*acceleration) > pushes
            ):
                return False
        return True


_SAMPLES = 16
_EASED = 1.05
"""By how much a course that leads on may be faster than one that begins at rest: its peak is short."""


def _moved(
    x: float, v: float, a: float, end: float, seconds: float, share: float
) -> tuple[float, float, float]:
    """Return position, velocity and acceleration along an axis after a share of the time."""
    v, a = v * seconds, a * seconds**2
    d = end - x - v - a / 2.0
    e = -(v + a)
    coefficients = (
        x,
        v,
        a / 2.0,
        0.0,
        35.0 * d - 15.0 * e - 2.5 * a,
        -84.0 * d + 39.0 * e + 7.0 * a,
        70.0 * d - 34.0 * e - 6.5 * a,
        -20.0 * d + 10.0 * e + 2.0 * a,
    )
    position = velocity = acceleration = 0.0
    for one in reversed(coefficients):  # all three by Horner's rule
        acceleration = acceleration * share + 2.0 * velocity
        velocity = velocity * share + position
        position = position * share + one
    return position, velocity / seconds, acceleration / seconds**2


PACE = 1.2
"""How much longer than until it is to be there a course is that leads to what moves.

A course slows down towards its end. Told anew twice a second, one that long has the drone at such an object.
"""
LONGER = 1.08
LONGEST = 3.0
"""By which factor longer courses are tried, and the seconds of the longest.

One that is longer sets out slowly: told anew on its way again and again, a drone would never get anywhere.
"""
GENTLY = 1.25
"""Seconds of a course to a place on the way, where none to the end is gentle enough."""
_PARTS = 10


def course_to(
    here: Setpoint, target: Point, limits: Limits, speed: float, seconds: float
) -> Course:
    """Return a course that leads a drone on to a target, or, if that is not gentle enough, to a place on the way.

    It is to be there in so many seconds, or as soon as its speed allows.
    """
    moves = hypot(*here.velocity)
    fastest = max(_EASED * speed, moves)
    metres = dist(here.position, target)
    takes = max(SHORTEST, PACE * seconds, metres / speed)
    longest = max(PACE * seconds, LONGEST)
    while takes <= longest:
        course = Course(here, target, takes)
        if course.keeps(limits, fastest, MOST):
            return course
        takes *= LONGER
    return next(
        course
        for course in _part_ways(here, target, speed)
        if course.end == _stop(here) or course.keeps(limits, fastest, 1.5 * MOST)
    )


def _part_ways(here: Setpoint, target: Point, speed: float) -> Iterator[Course]:
    """Yield courses to places nearer and nearer to where the drone would stop."""
    stop = _stop(here)
    metres = dist(here.position, target)
    most = min(1.0, 1.5 * speed * GENTLY / metres) if metres else 1.0
    for part in range(_PARTS, -1, -1):
        share = most * part / _PARTS
        x, y, z = (a + share * (b - a) for a, b in zip(stop, target, strict=True))
        yield Course(here, (x, y, z), GENTLY)


def _stop(here: Setpoint) -> Point:
    """Return where a drone would stop soon."""
    x, y, z = (a + 0.3 * GENTLY * v for a, v in zip(here.position, here.velocity, strict=True))
    return x, y, z
