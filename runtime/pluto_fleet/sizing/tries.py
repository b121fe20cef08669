"""Flying one candidate after the other, as often as it takes to know what it can promise."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

from ..process.workers import in_workers
from .bounds import FIRST_LOOK, Rule, lower, upper
from .fleets import Counts, Stock
from .question import Question, Run

if TYPE_CHECKING:
    from ..files.fleet import FleetFile

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
        """How many there are."""
        return sum(self.counts)

    @property
    def succeeded(self) -> int:
        """How many runs did."""
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
        """Add a run, and judge."""
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
        self,
        question: Question,
        stock: Stock,
        rule: Rule,
        *,
        seed: int,
        jobs: int,
        watch: Watch,
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
        """Return whether a fleet can be promised, after as many runs as that takes."""
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
