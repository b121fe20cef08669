"""The answer: the smallest fleet that can be promised, or why there is none.

What a failed run says is a symptom: its mission was late, or a drone fell. The cause is what makes the
runs succeed if it is taken away: the mishaps, the limit of drones in the air, the time of charging, the
distance that drones keep.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from statistics import median

from ..files.fleet import FleetFile
from ..files.plan_check import unflyable
from ..shared.alone.world import Faults
from ..shared.domain.text import counted, duration, number, quoted
from .fleets import Counts, Stock
from .question import LATE, Question, swapping
from .search import Search
from .tries import Rule, Tally, Tries, Watch, flown

RUNS = 40
MOST_RUNS = 300
"""Runs in which a change is tried: as many as it took to refuse the fleet, within these bounds."""

AT_ONCE = 1.0
"""Seconds in which a battery is charged that costs no time."""

_FEW = 5
_MOST_REASONS = 3


@dataclass(frozen=True, slots=True)
class Cause:
    """A cause, in words."""

    what: str
    """Its kind: `alone`, `faults`, `airborne`, `charging`, `apart`, `drones`, `runs` or `reason`."""
    text: str


class Causes:
    """Looks for what keeps the largest fleets from succeeding."""

    def __init__(self, tries: Tries) -> None:
        self._tries = tries
        self._question = tries.question

    def late_alone(self, counts: Counts) -> bool:
        """Return whether a mission takes too long that has a whole fleet for itself.

        It is the one that does so with the largest: which drones it gets may depend on how many there are.
        """
        fleet = self._tries.stock.of(counts)
        if fleet is None or self._late is None:
            return False
        return self._too_long(self._late[0], fleet, 1) is not None

    def found(self) -> list[Cause]:
        """Return the causes, the surest first."""
        if self._late is not None:
            return [self._alone(*self._late)]
        best = self._best
        causes = [*self._changes(best), *self._more(best)]
        return [*causes, *reasons(self._question, best)]

    @property
    def _best(self) -> Tally:
        tallies = self._tries.tallies.values()
        return max(tallies, key=lambda one: (one.succeeded / len(one.runs), one.drones))

    @cached_property
    def _late(self) -> tuple[str, float] | None:
        """The mission that takes too long with the largest fleet for itself, and how long; None: none does."""
        for mission in sorted(self._question.missions, key=lambda one: -len(one.trips)):
            took = self._too_long(mission.name, self._tries.stock.largest, _FEW)
            if took is not None:
                return mission.name, took
        return None

    def _too_long(self, mission: str, fleet: FleetFile, runs: int) -> float | None:
        """Return how long a mission takes with this fleet for itself, if that is always too long."""
        within = self._question.within
        tries = self._tries
        if within is None:
            return None
        alone = self._question.alone(mission)
        flights = list(flown(alone, fleet, tries.seed, 0, runs, tries.jobs))
        late = all(run.success and run.seconds > within for run in flights)
        return median(run.seconds for run in flights) if late else None

    def _alone(self, mission: str, took: float) -> Cause:
        drones = counted(len(self._tries.stock.largest.drones), "drone")
        text = (
            f"mission {quoted(mission)} takes {duration(took)} even if it has {drones} for itself and"
            f" nothing goes wrong: more than {duration(self._question.within or 0.0)}"
        )
        return Cause("alone", text)

    def _changes(self, best: Tally) -> Iterator[Cause]:
        question = self._question
        fleet = self._fleet(best)
        drones = counted(best.drones, "drone")
        if question.faults != Faults():
            calm = replace(question, faults=Faults())
            if self._holds(calm, fleet):
                text = f"mishaps (--fail): without them {drones} would do, or fewer"
                if any("aboard" in reason for _, reason in best.failures):
                    text += (
                        "; one with an item aboard ends its mission, however many drones there are"
                    )
                yield Cause("faults", text)
        limit = fleet.max_airborne
        if limit is not None and self._holds(question, replace(fleet, max_airborne=None)):
            text = f"max_airborne = {limit} keeps drones on the ground: without it {drones} would do, or fewer"
            yield Cause("airborne", text)
        stock = self._tries.stock
        more = replace(stock, most=2 * stock.most).largest
        if len(more.drones) > stock.most and self._holds(question, more):
            text = f"more drones: {len(more.drones)} would do, or fewer (--max says how many are tried)"
            yield Cause("drones", text)
        quick = replace(question, app=swapping(question.app, AT_ONCE))
        if self._holds(quick, replace(fleet, charges_at_home=True)):
            why = "" if fleet.charges_at_home else "nothing charges them at home, and "
            text = (
                f"{why}drones wait for their batteries: if these were full at once, {drones} would do, or"
                " fewer (--swap says how long it takes to swap one)"
            )
            yield Cause("charging", text)
        if fleet.apart and self._holds(question, replace(fleet, apart=0.0)):
            text = (
                f"drones wait for one another: if they need not keep {number(fleet.apart)} m apart,"
                f" {drones} would do, or fewer"
            )
            yield Cause("apart", text)

    def _more(self, best: Tally) -> Iterator[Cause]:
        """Yield what more runs may change."""
        tallies = self._tries.tallies.values()
        rate = best.succeeded / len(best.runs)
        equal = (one for one in tallies if one.succeeded / len(one.runs) == rate)
        best = min(equal, key=lambda one: one.drones)
        rule = self._tries.rule
        low, high = best.bounds
        if high >= rule.confidence:
            text = (
                f"{counted(best.drones, 'drone')} may be enough, at {percent_of(low)} to"
                f" {percent_of(high)}: more runs would tell (--runs {10 * rule.runs})"
            )
            yield Cause("runs", text)

    def _fleet(self, tally: Tally) -> FleetFile:
        fleet = self._tries.stock.of(tally.counts)
        assert fleet is not None
        return fleet

    def _holds(self, question: Question, fleet: FleetFile) -> bool:
        """Return whether a change makes the runs succeed, and not only luck: with the same seeds as before."""
        rule = self._tries.rule
        best = self._best
        most = max(RUNS, min(len(best.runs), MOST_RUNS))
        tally = Tally(counts=())
        for run in flown(question, fleet, self._tries.seed, 0, most, self._tries.jobs):
            tally.take(run, rule)
            if rule.refused(len(tally.runs), tally.failed):
                return False
        return 2 * tally.failed / most <= best.failed / len(best.runs)


def reasons(question: Question, tally: Tally) -> Iterator[Cause]:
    """Yield why a fleet's runs have failed, the most frequent reasons first."""
    for (mission, reason), count in tally.failures.most_common(_MOST_REASONS):
        why = f"fails: {reason}" if reason else f"is not completed {when(question)}"
        what = f"{count} of {counted(len(tally.runs), 'run')}: mission {quoted(mission)}"
        yield Cause("reason", f"{what} {reason if reason == LATE else why}")


def when(question: Question) -> str:
    """Return by when all must be completed, in words."""
    return "" if question.within is None else f"within {duration(question.within)}"


def percent_of(share: float) -> str:
    """Return a share with as many digits as one near 1 needs."""
    return f"{number(100 * share)} %" if share in (0.0, 1.0) else f"{100 * share:.1f} %"


SWAP = 60.0
"""Seconds in which a practised person swaps the battery of a drone that is this small."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """What is told."""

    question: Question
    stock: Stock
    rule: Rule
    found: Tally | None
    """The smallest fleet that can be promised."""
    tallies: Sequence[Tally]
    """All that were flown, smaller ones first."""
    causes: Sequence[Cause] = ()
    """Why there is none; or, if there is one, why a drone less is too few."""
    with_swaps: Counts | None = None
    """The drones that would do if batteries were swapped; None: no fewer, or they are."""


def sized(
    question: Question, stock: Stock, rule: Rule, *, seed: int, jobs: int, watch: Watch
) -> Answer:
    """Fly candidate fleets until the smallest is found that can be promised."""

    @cache
    def able(counts: Counts) -> bool:
        fleet = stock.of(counts)
        assert fleet is not None
        return not unflyable(question.missions, question.app, fleet, fleet.airspace)

    tries = Tries(question, stock, rule, seed=seed, jobs=jobs, watch=watch)
    causes = Causes(tries)
    search = Search(tries, able, causes.late_alone)
    counts = search.smallest()
    tallies = sorted(tries.tallies.values(), key=lambda one: (one.drones, one.counts))
    if counts is None:
        why = causes.found() if tallies else _out_of_reach(question, stock)
        return Answer(
            question=question, stock=stock, rule=rule, found=None, tallies=tallies, causes=why
        )
    found = tries.tallies[counts]
    smaller = [one for one in tallies if one.drones < found.drones and one.failed]
    near = max(smaller, key=lambda one: (one.drones, one.succeeded), default=None)
    fewer = None
    if question.swapped is None:
        quick = replace(question, app=swapping(question.app, SWAP))
        others = Tries(quick, stock, rule, seed=seed, jobs=jobs, watch=watch)
        left = Search(others, able, lambda _: True).reduced(counts, range(len(counts)))
        fewer = left if sum(left) < found.drones else None
    return Answer(
        question=question,
        stock=stock,
        rule=rule,
        found=found,
        tallies=tallies,
        causes=list(reasons(question, near)) if near is not None else [],
        with_swaps=fewer,
    )


def _out_of_reach(question: Question, stock: Stock) -> list[Cause]:
    """Return which trips no fleet of the stock can do, whatever its size."""
    found = unflyable(question.missions, question.app, stock.fleet, stock.fleet.airspace)
    if not found:  # there is no room for as many as that takes
        return [Cause("drones", f"more than {stock.most} drones are needed: --max says how many")]
    return [Cause("reach", f"{one.called}: {one.reason}") for one in found]
