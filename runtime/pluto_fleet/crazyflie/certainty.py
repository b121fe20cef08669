"""How sure a Crazyflie is of its position: its estimator's variance, over the last second.

Whoever sees where it is by beacons becomes sure: the variance is small, and grows when they are not
seen any more. Whoever only sees the ground pass by never is, for its start is nowhere: then it counts
that the variance stays what it is.
"""

from __future__ import annotations

from collections import deque
from math import inf, isfinite

LONG = 1.0
"""Seconds that it must be so: just after a start the estimate still settles."""
_STEADY = 0.001
"""Square metres by which the variance may change meanwhile of one that only sees the ground."""
_STALE = 1.5

Variances = tuple[float, ...]


class Certainty:
    """What its variances have been."""

    def __init__(self) -> None:
        self._told: deque[tuple[float, Variances]] = deque()

    @property
    def variance(self) -> float | None:
        """The largest of the three axes', in square metres, as it was last."""
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

    def sure(self, time: float, within: float) -> bool:
        """Say whether it has known its place for long enough, to so many metres on each axis."""
        return self._tells(time) and all(max(told) <= within**2 for _, told in self._told)

    def steady(self, time: float) -> bool:
        """Say whether it has been as sure as it is for long enough, however sure that is."""
        if not self._tells(time):
            return False
        axes = zip(*(variances for _, variances in self._told), strict=True)
        return all(max(axis) < inf and max(axis) - min(axis) <= _STEADY for axis in axes)

    def lost(self, beyond: float) -> bool:
        """Say whether it has not known its place for long enough, not even to so many metres."""
        return self._is_long() and all(max(told) > beyond**2 for _, told in self._told)

    def doubts(self, beyond: float) -> bool:
        """Say whether it does not know its place to so many metres at the moment."""
        variance = self.variance
        return variance is not None and variance > beyond**2

    def _tells(self, time: float) -> bool:
        return self._is_long() and time - self._told[-1][0] <= _STALE

    def _is_long(self) -> bool:
        return bool(self._told) and self._told[-1][0] - self._told[0][0] >= LONG
