"""Flying one candidate after the other, as often as it takes to know what it can promise.

Bounds of the probability of success are Wilson's, each one-sided. A promise by fewer runs than were
allowed needs a surer bound than one by all of them, since looking often finds luck: so about one in
twenty fleets that only just miss the confidence is promised, and hardly any that misses it by more.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from math import ceil, sqrt
from statistics import NormalDist

from ..files.fleet import FleetFile
from ..process.workers import in_workers
from ..shared.domain.errors import BadInput
from ..shared.domain.text import number
from .fleets import Counts, Stock
from .question import Question, Run

SURE = 0.95
SURER = 0.99
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
    share = 1 - failed / runs
    square = z * z / runs
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
        if runs >= self.runs:
            return failed <= self.most
        return lower(runs, failed, SURER) >= self.confidence

    def refused(self, runs: int, failed: int) -> bool:
        """Return whether these runs rule it out, or no further ones could show it."""
        if failed > self.most:
            return True
        return runs >= FIRST_LOOK and upper(runs, failed, SURER) < self.confidence


HOPEFUL = 100
"""Runs after which a fleet that is not refused is taken for good, until the smallest one is looked at."""

_TOGETHER = 5
"""Runs that a worker does one after the other."""


class Verdict(Enum):
    """What is known of a fleet."""

    OPEN = "open"
    REFUSED = "refused"
    PROMISED = "promised"


@dataclass(kw_only=True)
class Tally:
    """The runs of one fleet so far."""

    counts: Counts
    runs: list[Run] = field(default_factory=list)
    failed: int = 0
    verdict: Verdict = Verdict.OPEN

    @property
    def drones(self) -> int:
        return sum(self.counts)

    @property
    def succeeded(self) -> int:
        return len(self.runs) - self.failed

    @property
    def bounds(self) -> tuple[float, float]:
        """Between what the probability of success lies."""
        return lower(len(self.runs), self.failed), upper(len(self.runs), self.failed)

    @property
    def failures(self) -> Counter[tuple[str, str]]:
        """How often runs failed by which mission and reason."""
        return Counter((run.mission, run.reason) for run in self.runs if not run.success)

    def take(self, run: Run, rule: Rule) -> None:
        self.runs.append(run)
        self.failed += not run.success
        runs = len(self.runs)
        if rule.refused(runs, self.failed):
            self.verdict = Verdict.REFUSED
        elif rule.promised(runs, self.failed):
            self.verdict = Verdict.PROMISED


Watch = Callable[[Tally], object]


class Tries:
    """Flies candidates, all with the same seeds, and remembers what came of it."""

    def __init__(
        self, question: Question, stock: Stock, rule: Rule, *, seed: int, jobs: int, watch: Watch
    ) -> None:
        self.question, self.stock, self.rule = question, stock, rule
        self.tallies: dict[Counts, Tally] = {}
        self.seed, self.jobs, self._watch = seed, jobs, watch
        self._enough = HOPEFUL
        """How many runs leave hope."""

    def hopeful(self, counts: Counts) -> bool:
        """Return whether some runs leave hope for a fleet."""
        return self._flown(counts, self._enough).verdict is not Verdict.REFUSED

    def promised(self, counts: Counts) -> bool:
        tally = self._flown(counts, self.rule.runs)
        if tally.verdict is Verdict.REFUSED:  # a larger one may well fail in that very run, too
            self._enough = max(self._enough, len(tally.runs))
        return tally.verdict is Verdict.PROMISED

    def _flown(self, counts: Counts, most: int) -> Tally:
        tally = self.tallies.setdefault(counts, Tally(counts=counts))
        fleet = self.stock.of(counts)
        assert fleet is not None, "only fleets that there is room for are flown"
        for limit in (FIRST_LOOK, most):
            if tally.verdict is Verdict.OPEN:
                self._fly_on(tally, fleet, min(limit, most, self.rule.runs))
        return tally

    def _fly_on(self, tally: Tally, fleet: FleetFile, most: int) -> None:
        for run in flown(self.question, fleet, self.seed, len(tally.runs), most, self.jobs):
            tally.take(run, self.rule)
            self._watch(tally)
            if tally.verdict is not Verdict.OPEN:
                return


def flown(
    question: Question, fleet: FleetFile, seed: int, done: int, most: int, jobs: int
) -> Iterator[Run]:
    """Yield runs with the seeds from `seed + done` up to `seed + most`, flown in workers."""

    def together(places: range) -> list[Run]:
        return [question.fly(fleet, seed + place) for place in places]

    parts = [range(start, min(start + _TOGETHER, most)) for start in range(done, most, _TOGETHER)]
    for runs in in_workers(together, parts, jobs, quiet=True):
        yield from runs
