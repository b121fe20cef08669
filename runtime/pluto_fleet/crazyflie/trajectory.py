"""How long a trajectory takes, where one ends that is broken off, and how fast the drone follows.

A trajectory of the high-level commander is a polynomial of the seventh order that begins and ends at
rest: its peak speed is 35/16 of its mean one, and over a short way it is the acceleration that counts.
The firmware's planner plans as fast as it is asked to; the position controller that follows is limited
by parameters, to a metre per second as it comes. A faster trajectory is at its end long before the
drone is, which then arrives in the middle of its way, or not in time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import dist, inf, sqrt
from typing import TYPE_CHECKING

from plutoc_runtime.fleet.reach import CLIMB_SPEED

from . import messages, parameters

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .session import CrazyflieSession
    from .state import State


PEAK = 2.19
"""Peak speed over mean speed."""
_PUSH, _MOST = 7.52, 4.0
"""Peak acceleration over distance and squared time; metres per second squared that it may be."""
SHORTEST = 1.0
"""Seconds: three metres in half of one have thrown a drone over."""
NEAR = 0.08
"""Metres from its target at which it has arrived: it sways, and is to stay within ten centimetres."""
SLACK = 8.0
"""Seconds that a trajectory may take longer: the drone is a little behind it, and settles at its end.

By beacons as unsure as UWB (0.15 m) that took 4.6 s at most, in 400 simulated trajectories."""
REST = 0.15
"""Metres per second below which it hovers: wind and beacons let it sway."""

_AHEAD, _BRAKE = 0.2, 3.6
"""The share of the way that it would make while it stops, which it is let go on: it cannot stop at once,
and is flown back less. What it then brakes with, at one metre per second and in one second."""
_SOON, _RECENT = 0.05, 0.5
"""Seconds between two states, by the drone's clock, from which a speed can be told."""
_LOOK = 0.3
"""Seconds for which it must hover: an estimate sways from one word to the next."""
_FASTEST = 5.0
"""Metres per second; what seems faster is a position that has jumped, or a clock."""
_FARTHEST = 1.0
"""Metres that it may take to stop."""
_LOWEST = 0.2
"""Metres above the ground at which it may hover."""


def shortest_duration(metres: float, speed: float) -> float:
    """Return how long a trajectory must take for its peak speed to stay below this."""
    return max(SHORTEST, PEAK * metres / speed, sqrt(_PUSH * metres / _MOST))


def hovers(states: Sequence[State], off: Callable[[State], float]) -> bool:
    """Say whether a drone has been near its target and at rest for a moment, by what it told.

    The last of the states is from just now; `off`: how many metres it was away. At the end of a
    trajectory its commander waits for it: that says nothing of how fast it still comes. One that shoots
    over is near on its way past, too.
    """
    now = states[-1]
    for then in reversed(states):
        if not off(then) < NEAR:
            return False
        passed = now.since(then)
        if passed >= _LOOK:
            return now.distance(then.position) <= REST * passed
    return False


def braking(before: State | None, state: State) -> tuple[Point, float]:
    """Return where a drone is to hover that is to stop now, and how long that takes.

    That is never far, even if its telemetry is wrong: else it is where it says that it is.
    """
    target, seconds = state.position, SHORTEST
    passed = 0.0 if before is None else state.since(before)
    if before is not None and _SOON <= passed <= _RECENT:
        speed = state.distance(before.position) / passed
        if speed <= _FASTEST:
            seconds = max(SHORTEST, _BRAKE * speed / _MOST)
            share = min(_AHEAD * seconds, _FARTHEST / speed if speed else 0.0) / passed
            x, y, z = (
                now + (now - then) * share
                for now, then in zip(state.position, before.position, strict=True)
            )
            target = x, y, z
    return (target[0], target[1], max(_LOWEST, target[2])), seconds


_LIMIT_PARAMETERS = ("posCtlPid.xVelMax", "posCtlPid.yVelMax", "posCtlPid.zVelMax")
DEFAULT_LIMIT = 1.0
"""Metres per second, as long as it has not said: what the firmware has of its own."""
_CLIMB = 2 * CLIMB_SPEED
"""Metres per second that an app climbs and lands with at most."""
_SINKS = 0.5
"""The share of its upward limit at which it follows a landing so closely that it touches down."""
_ROUNDING = 1e-3


@dataclass(frozen=True, slots=True)
class SpeedLimits:
    """Metres per second ahead, aside and up; endless for a firmware that has no such limit."""

    limits: tuple[float, float, float]

    def seconds(self, start: Point, target: Point, speed: float) -> float:
        """Return how long a trajectory must take that it can follow, and that never exceeds a speed."""
        x, y, z = self.limits  # the first two are along its nose and across, wherever that points
        across, up = dist(start[:2], target[:2]), abs(target[2] - start[2])
        followed = PEAK * max(across / min(x, y), up / z)
        return max(shortest_duration(dist(start, target), speed), followed)

    def seconds_down(self, height: float, speed: float) -> float:
        """Return how long a landing must take: its motors stop at its end, wherever it is then."""
        return self.seconds(
            (0.0, 0.0, height), (0.0, 0.0, 0.0), min(speed, _SINKS * self.limits[2])
        )

    def too_slow_for(self, speed: float) -> Iterator[str]:
        """Yield why a drone that may fly so fast cannot."""
        asked = (speed, speed, min(speed, _CLIMB))
        for name, limit, wanted in zip(_LIMIT_PARAMETERS, self.limits, asked, strict=True):
            if wanted > limit + _ROUNDING:
                yield messages.too_fast(wanted, name, limit)


def speed_limits_of(session: CrazyflieSession) -> SpeedLimits:
    """Return what its parameters say; it need not be so as long as they have not all been read."""
    known = parameters.known(session)
    x, y, z = (_limit(session, known.get(name), name) for name in _LIMIT_PARAMETERS)
    return SpeedLimits((x, y, z))


def _limit(session: CrazyflieSession, value: float | None, name: str) -> float:
    if parameters.element_of(session.cf, name) is None:
        return inf
    return value if value is not None and value > 0.0 else DEFAULT_LIMIT
