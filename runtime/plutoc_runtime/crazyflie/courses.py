"""How long a course takes, and where one ends that is broken off.

A course of the high-level commander eases in and out: its peak speed is 35/16 of its mean one.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..model import Point
    from .state import State

PEAK = 2.19
"""Peak speed over mean speed."""
SHORTEST = 1.0
"""Seconds: three metres in half of one have thrown a drone over."""
NEAR = 0.1
"""Metres from its target at which it has arrived."""
SLACK = 4.0
"""Seconds that a course may take longer."""

_AHEAD = 0.2
"""Seconds of its way that a drone is let go on when it is to stop: it cannot stop at once, and is
flown back less."""
_LOWEST = 0.2
"""Metres above the ground at which it may hover."""


def seconds_for(metres: float, speed: float) -> float:
    """Return how long a course must take for its peak speed to stay below this."""
    return max(SHORTEST, PEAK * metres / speed)


def is_speed(speed: float) -> bool:
    """Say whether one can fly at this speed."""
    return isfinite(speed) and speed > 0.0


def is_target(target: Point) -> bool:
    """Say whether one can fly to this place."""
    return all(isfinite(value) for value in target) and target[2] > 0.0


def stop(before: State | None, state: State) -> Point:
    """Return where a drone is to hover that is to stop now."""
    x, y, z = state.position
    if before is not None and 0.0 < state.time - before.time < 0.5:
        share = _AHEAD / (state.time - before.time)
        x, y, z = (
            now + (now - then) * share
            for now, then in zip(state.position, before.position, strict=True)
        )
    return x, y, max(_LOWEST, z)
