"""How sure a Crazyflie is of its position: its estimator's variance, over the last second.

Whoever sees where it is by beacons becomes sure: the variance is small. Whoever only sees the ground
pass by never is, for its start is nowhere: then it counts that the variance stays what it is.
"""

from __future__ import annotations

from collections import deque
from math import inf, isfinite

MOST = 0.001
"""Square metres: three centimetres, as a standard deviation."""
LONG = 1.0
"""Seconds that it must be so: just after a start the estimate still settles."""
_STALE = 1.5

Variances = tuple[float, ...]


class Certainty:
    """What its variances have been."""

    def __init__(self) -> None:
        self._told: deque[tuple[float, Variances]] = deque()

    @property
    def variance(self) -> float | None:
        """The largest of the three axes', as it was last."""
        return max(self._told[-1][1]) if self._told else None

    def hear(self, variances: Variances, time: float) -> None:
        """It told them."""
        if self._told and time - self._told[-1][0] > _STALE:
            self._told.clear()
        self._told.append((time, tuple(v if isfinite(v) else inf for v in variances)))
        while len(self._told) > 1 and time - self._told[1][0] >= LONG:
            self._told.popleft()

    def forget(self) -> None:
        """Its estimate begins anew."""
        self._told.clear()

    def sure(self, time: float, *, by_beacons: bool = True) -> bool:
        """Say whether it has been sure for long enough."""
        if not self._told or time - self._told[-1][0] > _STALE:
            return False
        if self._told[-1][0] - self._told[0][0] < LONG:
            return False
        axes = list(zip(*(variances for _, variances in self._told), strict=True))
        if by_beacons:
            return all(max(axis) <= MOST for axis in axes)
        return all(max(axis) < inf and max(axis) - min(axis) <= MOST for axis in axes)
