"""The position estimate of a drone: its variance and its error.

A position that comes in is a fix. The variance depends on how noisy fixes are and how often they
come; without any it grows with the square of the time, and the estimate leaves the truth likewise.
Largest of the three axes' variances on real firmware (2026.08), and here, in square metres:

                                 measured          here
    100 Hz, 1 cm                   0.00044           0.00044
    20 Hz, 1 cm                    0.00064           0.00061
    10 Hz, 1 cm                    0.00084           0.00085
    like UWB: 5-15 cm, 100 Hz      0.0015 to 0.003   0.0012 to 0.0030
    11 s without a fix             2.5               2.5
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin, sqrt
from random import Random

from .flight_log import Point

NOISE, RATE = 0.01, 100.0
"""The noise of fixes in metres, and their rate per second."""
_LEAST, _PER_NOISE, _PER_GAP = 0.00022, 0.018, 0.004
"""Square metres: at best, for each metre of noise, for each second between fixes."""
_GROWS = 2.5 / 11.0**2
"""Square metres of variance, and metres of error, after a second without a fix."""
_MOST = 100.0
"""The largest variance, in square metres."""
_LONGEST_GAP = 0.5
"""The longest interval of consecutive fixes, in seconds."""
_NEVER = -1e9


@dataclass(slots=True)
class Estimator:
    """The estimate of one drone's position; times are handed in."""

    random: Random
    own: bool = True
    """Whether it localizes itself; else it depends on positions from outside."""
    noise: float = NOISE
    rate: float = RATE
    """Of its own fixes."""
    blind: bool = False
    """Whether no fix arrives any more."""
    _fixed_at: float = _NEVER
    _gap: float = 1.0 / RATE
    _away: tuple[float, float] = field(init=False)
    """The direction in which its estimate drifts."""

    def __post_init__(self) -> None:
        self._turn()

    def told(self, now: float) -> None:
        """Process a position from outside."""
        if not self.blind:
            if 0.0 < now - self._fixed_at < _LONGEST_GAP:
                self._gap = now - self._fixed_at
            self._fixed_at = now

    def step(self, now: float) -> None:
        """Advance the time, with fixes of its own."""
        if self.own and not self.blind:
            self._gap = 1.0 / self.rate
            self._fixed_at = now - now % self._gap

    def lose(self, on: bool) -> None:
        """Block all fixes, or unblock them."""
        if on and not self.blind:
            self._turn()
        self.blind = on

    def variance(self, now: float) -> float:
        """Return the variance of its position, in square metres."""
        age = now - self._fixed_at
        settled = _LEAST + _PER_NOISE * self.noise + _PER_GAP * self._gap
        return min(_MOST, settled + _GROWS * age * age)

    @property
    def sway(self) -> float:
        """The factor of its sway relative to the usual noise; assumed, not measured."""
        return sqrt(self.noise / NOISE)

    def error(self, now: float) -> Point:
        """Return the error of its estimate; zero before the first fix."""
        if self._fixed_at == _NEVER:
            return (0.0, 0.0, 0.0)
        age = now - self._fixed_at
        if age < _LONGEST_GAP:
            return (0.0, 0.0, 0.0)
        off = min(_MOST, _GROWS * (age - _LONGEST_GAP) ** 2)
        return (off * self._away[0], off * self._away[1], 0.0)

    def _turn(self) -> None:
        angle = self.random.uniform(-pi, pi)
        self._away = (cos(angle), sin(angle))
