"""How sure a Crazyflie is of its position: its estimator's variance, and for how long it is small."""

from __future__ import annotations

from math import inf, isfinite

MOST = 0.001
"""Square metres: three centimetres, as a standard deviation."""
LONG = 1.0
"""Seconds that it must be so: just after a start the estimate still settles."""
_STALE = 2.0


class Certainty:
    """What its variances have been."""

    def __init__(self) -> None:
        self.variance: float | None = None
        """The largest of the three axes', as it was last."""
        self._at = self._since = -inf

    def hear(self, variances: tuple[float, ...], time: float) -> None:
        """It told them."""
        worst = max(value if isfinite(value) else inf for value in variances)
        small = worst <= MOST
        if not small or self.variance is None or self.variance > MOST or self.stale(time):
            self._since = time
        self.variance, self._at = worst, time

    def forget(self) -> None:
        """Its estimate begins anew."""
        self.variance, self._at, self._since = None, -inf, -inf

    def stale(self, time: float) -> bool:
        """Say whether nothing is known of now."""
        return time - self._at > _STALE

    def sure(self, time: float) -> bool:
        """Say whether it has been sure for long enough."""
        return (
            self.variance is not None
            and self.variance <= MOST
            and not self.stale(time)
            and self._at - self._since >= LONG
        )
