"""How fast a Crazyflie can follow a course, by parameters of its position controller.

The firmware's planner plans as fast as it is asked to; the controller that follows is limited, to a
metre per second as it comes. A faster course is at its end long before the drone is, which then
arrives in the middle of its way, or not in time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import dist, inf
from typing import TYPE_CHECKING

from plutoc_runtime.fleet.energy import CLIMB_SPEED

from . import parameters, words
from .courses import PEAK, seconds_for

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .session import Session

_NAMES = ("posCtlPid.xVelMax", "posCtlPid.yVelMax", "posCtlPid.zVelMax")
USUAL = 1.0
"""Metres per second, as long as it has not said: what the firmware has of its own."""
_CLIMB = 2 * CLIMB_SPEED
"""Metres per second that an app climbs and lands with at most."""
_SINKS = 0.5
"""The share of its upward limit at which it follows a landing so closely that it touches down."""
_EXACT = 1e-3


@dataclass(frozen=True, slots=True)
class Pace:
    """Metres per second ahead, aside and up; endless for a firmware that has no such limit."""

    limits: tuple[float, float, float]

    def seconds(self, start: Point, target: Point, speed: float) -> float:
        """Return how long a course must take that it can follow, and that never exceeds a speed."""
        x, y, z = self.limits  # the first two are along its nose and across, wherever that points
        across, up = dist(start[:2], target[:2]), abs(target[2] - start[2])
        followed = PEAK * max(across / min(x, y), up / z)
        return max(seconds_for(dist(start, target), speed), followed)

    def seconds_down(self, height: float, speed: float) -> float:
        """Return how long a landing must take: its motors stop at its end, wherever it is then."""
        return self.seconds(
            (0.0, 0.0, height), (0.0, 0.0, 0.0), min(speed, _SINKS * self.limits[2])
        )

    def too_slow_for(self, speed: float) -> Iterator[str]:
        """Yield why a drone that may fly so fast cannot."""
        asked = (speed, speed, min(speed, _CLIMB))
        for name, limit, wanted in zip(_NAMES, self.limits, asked, strict=True):
            if wanted > limit + _EXACT:
                yield words.too_fast(wanted, name, limit)


AS_IT_COMES = Pace((USUAL, USUAL, USUAL))


def pace_of(session: Session) -> Pace:
    """Return what its parameters say; it need not be so as long as they have not all been read."""
    known = parameters.known(session)
    x, y, z = (_limit(session, known.get(name), name) for name in _NAMES)
    return Pace((x, y, z))


def _limit(session: Session, value: float | None, name: str) -> float:
    if parameters.element_of(session.cf, name) is None:
        return inf
    return value if value is not None and value > 0.0 else USUAL
