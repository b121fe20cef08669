"""Which of the ways in one gap, or one channel, runs beside which: so that few of them cross."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

_ROUNDS = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """A piece of a way along a gap or a channel: where it begins and ends, along it."""

    ends: tuple[tuple[float, int], tuple[float, int]]
    """Of each end the place, and to which side the way goes on there: -1 the lower one, 1 the other."""

    @property
    def low(self) -> float:
        """Where it begins."""
        return min(self.ends[0][0], self.ends[1][0])

    @property
    def high(self) -> float:
        """Where it ends."""
        return max(self.ends[0][0], self.ends[1][0])


def tracks(runs: Sequence[Run]) -> list[int]:
    """Return the track of each run, from 0; runs on one track do not meet."""
    order = sorted(range(len(runs)), key=lambda one: (_leaning(runs[one]), runs[one].low, one))
    for _ in range(_ROUNDS):
        changed = False
        for place in range(len(order) - 1):
            one, other = order[place], order[place + 1]
            if _crossings(runs[other], runs[one]) < _crossings(runs[one], runs[other]):
                order[place : place + 2] = other, one
                changed = True
        if not changed:
            break
    found: dict[int, int] = {}
    for one in order:
        beside = [found[other] for other in found if _meet(runs[one], runs[other])]
        found[one] = max(beside, default=-1) + 1
    return [found[one] for one in range(len(runs))]


def _leaning(run: Run) -> int:
    return run.ends[0][1] + run.ends[1][1]


def _meet(one: Run, other: Run) -> bool:
    return one.low <= other.high and other.low <= one.high


def _crossings(lower: Run, upper: Run) -> int:
    """Return how often two runs cross if one of them has the lower track."""
    outward = sum(side > 0 and upper.low <= at <= upper.high for at, side in lower.ends)
    return outward + sum(side < 0 and lower.low <= at <= lower.high for at, side in upper.ends)
