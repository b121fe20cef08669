"""How a drone follows what its planner asks for: late, and no faster than its position controller lets it.

A position error becomes a velocity, which is limited; the velocity follows with a lag. In height the
error is also summed up, which overshoots. Measured on real firmware (2026.08), and here:

                                          measured    here
    6 m planned at 3 m/s, near and at rest  2.8 s late  2.8 s late
    15 m planned at 2 m/s                   16.6 s      17.4 s
    a hold at 0.93 m/s shoots on            0.58 m      0.54 m
    a take-off to 1.5 m rises to            1.60 m      1.60 m
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, sin

from .record import Point

Limits = tuple[float, float, float]
"""Metres per second: forwards, sideways and upwards."""

_GAIN = 2.0
"""Metres per second for each metre of error."""
_SUMMED, _LEAKS = 0.8, 2.0
"""The same for each metre second of summed error in height; seconds in which the sum fades."""
_LAGS = (0.3, 0.3, 0.15)
"""Seconds in which the velocity follows, on each axis."""
_OVERHEAD = 1.1
"""The firmware lets a drone fly this much faster than its parameters say."""
_LEAST_UP = 0.5
"""Metres per second upwards that it is always allowed."""


@dataclass(slots=True)
class Tracking:
    """Where a body is, and how fast, while its motors turn."""

    position: list[float]
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    _sum: float = 0.0

    def step(self, target: Point, error: Point, yaw: float, limits: Limits, seconds: float) -> None:
        """Let it fly towards a target for a moment; `error`: how far off its estimate is."""
        x, y, z = (
            wanted - (here + off)
            for wanted, here, off in zip(target, self.position, error, strict=True)
        )
        c, s = cos(yaw), sin(yaw)
        forwards = _limited(_GAIN * (c * x + s * y), limits[0])
        sideways = _limited(_GAIN * (c * y - s * x), limits[1])
        up = _GAIN * z + _SUMMED * self._sum
        limit = max(_LEAST_UP, limits[2])
        if abs(up) < _OVERHEAD * limit:  # else the sum would grow for as long as it is limited
            self._sum += (z - self._sum / _LEAKS) * seconds
        wanted = (c * forwards - s * sideways, s * forwards + c * sideways, _limited(up, limit))
        for axis, lag in enumerate(_LAGS):
            share = min(1.0, seconds / lag)
            self.velocity[axis] += (wanted[axis] - self.velocity[axis]) * share
            self.position[axis] += self.velocity[axis] * seconds
        if self.position[2] <= 0.0:
            self.position[2], self.velocity[2] = 0.0, max(0.0, self.velocity[2])


def _limited(velocity: float, limit: float) -> float:
    most = _OVERHEAD * limit
    return min(most, max(-most, velocity))
