"""Why no fleet is large enough: found by flying again with one thing otherwise.

What a failed run says is a symptom: its mission was late, or a drone fell. The cause is what makes the
runs succeed if it is taken away: the mishaps, the limit of drones in the air, the time of charging, the
distance that drones keep.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from statistics import median
from typing import TYPE_CHECKING

from ..shared.alone.world import Faults
from ..shared.domain.text import counted, duration, number, quoted
from .batteries import swapping
from .question import LATE
from .tries import Tally, flown

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from .fleets import Counts
    from .question import Question
    from .tries import Tries

RUNS, MOST_RUNS = 40, 300
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
        self._tries, self._question = tries, tries.question

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
        """The fleet that came nearest."""
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
        within, tries = self._question.within, self._tries
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
        question, fleet = self._question, self._fleet(best)
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
        tallies, rate = self._tries.tallies.values(), best.succeeded / len(best.runs)
        equal = (one for one in tallies if one.succeeded / len(one.runs) == rate)
        best = min(equal, key=lambda one: one.drones)
        rule, (low, high) = self._tries.rule, best.bounds
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
        rule, best = self._tries.rule, self._best
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
