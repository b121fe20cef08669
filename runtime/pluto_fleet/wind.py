"""The wind of a simulated world, and what it takes of those that fly in it.

Drag grows with the square of the airspeed, as in ArduPilot's simulator (libraries/SITL/SIM_Frame.h, refSpd and
refAngle); rotors that must lift more for it take the power of a hovering rotor: momentum theory, thrust to the 3/2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import cos, hypot, pi, radians, sin, sqrt
from random import Random

from .shared.domain.motion import Motion

SPEED_AT_45 = 15.0
"""Metres a second through the air at which a multicopter leans by 45 degrees: drag is then as large as weight."""
_PERIODS = (5.0, 13.0, 37.0)
"""Seconds, of the waves that gusts are made of."""
_COURSES = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Wind:
    """A steady wind, and its gusts."""

    speed: float
    """Metres a second."""
    origin: float
    """The compass direction that it comes from, in radians."""
    gusts: float = 0.0
    """By how much it is weaker and stronger at most, in metres a second."""
    seed: int = 0

    def at(self, seconds: float) -> tuple[float, float]:
        """Return to where the air moves at a time, in metres a second east and north."""
        speed = self.speed
        if self.gusts:
            phases = zip(_PERIODS, _phases(self.seed), strict=True)
            waves = [sin(2 * pi * (seconds / period + phase)) for period, phase in phases]
            speed += self.gusts * sum(waves) / len(waves)
        return -speed * sin(self.origin), -speed * cos(self.origin)

    def on_map(self, north: float) -> tuple[float, float]:
        """Return to where it moves without its gusts, along x and y of a map.

        `north`: by how many degrees north is turned from up there, clockwise.
        """
        angle = self.origin + radians(north)
        return -self.speed * sin(angle), -self.speed * cos(angle)


@lru_cache
def _phases(seed: int) -> Sequence[float]:
    chance = Random(f"{seed}/gusts")
    return [chance.random() for _ in _PERIODS]


CALM = Wind(speed=0.0, origin=0.0)


def power(airspeed: float) -> float:
    """Return the power at an airspeed, over that of hovering in calm air."""
    drag = (airspeed / SPEED_AT_45) ** 2
    lifts = sqrt(1 + drag * drag)
    return lifts * sqrt(lifts)


def effort(motion: Motion, speed: float) -> float:
    """Return what a second in its wind takes of a battery, over one in calm air: hovering, or flying to all sides.

    The larger of the two, for a vehicle that flies at a speed over ground where it can.
    """
    x, y = motion.wind
    still = power(hypot(x, y))
    used = seconds = 0.0
    for east, north in _COURSES:
        over_ground = motion.against((0.0, 0.0, 0.0), (east, north, 0.0), speed)
        through = hypot(over_ground * east - x, over_ground * north - y)
        seconds += 1 / over_ground
        used += power(through) / power(over_ground) / over_ground
    return max(still, used / seconds)
