"""What runs that succeeded and failed say of the probability of success: bounds, and when to stop.

Bounds are Wilson's, each one-sided. A promise by fewer runs than were allowed needs a surer bound than
one by all of them, since looking often finds luck: so about one in twenty fleets that only just miss
the confidence is promised, and hardly any that misses it by more.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil, sqrt
from statistics import NormalDist

from ..shared.domain.errors import BadInput
from ..shared.domain.text import number

SURE, SURER = 0.95, 0.99
"""The confidence level of a bound after all runs, and of one before that."""

FIRST_LOOK = 20
"""Runs before a fleet is refused: one failure at the very beginning says little."""

AT_MOST = 1_000_000


def lower(runs: int, failed: int, sure: float = SURE) -> float:
    """Return the least probability of success that these runs allow."""
    return _wilson(runs, failed, -NormalDist().inv_cdf(sure))


def upper(runs: int, failed: int, sure: float = SURE) -> float:
    """Return the greatest probability of success that these runs allow."""
    return _wilson(runs, failed, NormalDist().inv_cdf(sure))


def _wilson(runs: int, failed: int, z: float) -> float:
    if not runs:
        return 0.0 if z < 0 else 1.0
    share, square = 1 - failed / runs, z * z / runs
    middle = share + square / 2
    half = z * sqrt((share * (1 - share) + square / 4) / runs)
    return min(1.0, max(0.0, (middle + half) / (1 + square)))


def least_runs(confidence: float) -> int:
    """Return how many runs show a confidence if all succeed."""
    z = NormalDist().inv_cdf(SURE)
    runs = ceil(confidence / (1 - confidence) * z * z - 1e-9)
    return runs if lower(runs, 0) >= confidence else runs + 1


def usual_runs(confidence: float) -> int:
    """Return how many runs are enough to show a confidence to a fleet that fails half as often."""
    return min(AT_MOST, max(200, round(10 / (1 - confidence))))


@dataclass(frozen=True, kw_only=True)
class Rule:
    """When a fleet is promised or refused, from its runs so far."""

    confidence: float
    runs: int
    """The most for one fleet."""

    def __post_init__(self) -> None:
        least = least_runs(self.confidence)
        if self.runs < least:
            raise BadInput(
                f"{self.runs} runs cannot show {number(100 * self.confidence)} %:"
                f" that takes {least} or more, if all succeed (--runs {usual_runs(self.confidence)})"
            )

    @cached_property
    def most(self) -> int:
        """How many of all runs may fail."""
        failed = 0
        while lower(self.runs, failed + 1) >= self.confidence:
            failed += 1
        return failed

    def promised(self, runs: int, failed: int) -> bool:
        """Return whether these runs show the confidence."""
        if runs >= self.runs:
            return failed <= self.most
        return lower(runs, failed, SURER) >= self.confidence

    def refused(self, runs: int, failed: int) -> bool:
        """Return whether these runs rule it out, or no further ones could show it."""
        if failed > self.most:
            return True
        return runs >= FIRST_LOOK and upper(runs, failed, SURER) < self.confidence
