"""The runs of a forecast, in a copy of this process: each is told in a few numbers."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ...flight.simulate import Sampling, simulate
from ...shared.domain.status import COMPLETED
from ...shared.fleet.reach import Lacks, Reach, chain_of, miss_of
from ...trials.case import fresh
from .rehearsal import FRAMES, MOST_CHAINS, Rehearsal, Waits

if TYPE_CHECKING:
    from ...flight.outcome import SimulationResult
    from ...shared.domain.model import Category, Point, Trip
    from .question import Question

FEWEST, MOST = 21, 1_001
"""Runs, if none are asked for: few percentiles need less; odd, so that the median is a run's."""

ENOUGH = 2.0
"""Seconds of CPU after which no further run begins."""

PATIENCE = 4.0
"""Seconds after which none does either, on a machine that is busy with other things."""

LONGEST = 12.0
"""Seconds after which no further run begins, however many there are: the median is yet to be rehearsed."""

SHORTEST = 0.25
"""Seconds between two looks at a rehearsal, at least."""


class End(NamedTuple):
    """How a mission ended in a run."""

    at: float | None
    """When; None: it did not."""
    completed: bool
    late: bool
    reason: str


class Run(NamedTuple):
    """One run, in seconds of virtual time."""

    seed: int
    seconds: float
    ends: Mapping[str, End]
    battery: float | None
    """The lowest level of a battery at a landing; None: no drone flew."""
    given_up: str
    """Why it was cut off; empty: it was not."""

    @property
    def whole(self) -> bool:
        """Whether every mission was completed."""
        return all(end.completed for end in self.ends.values())


class Needs(NamedTuple):
    """What drones need to fly any mission at first."""

    levels: Mapping[str, float]
    """Of each drone: the least level of battery with which it can; infinite: it never can. None: it is
    there for what comes later, or what an evaluator sends for."""
    why: Mapping[str, str]
    """Why those never can."""


OTHER = "hooks.py remembers earlier runs, and flies another one"


class Rehearsed(NamedTuple):
    """What came of the median run when it was flown once more, to be watched."""

    waits: Waits
    trouble: str = ""
    """Why it could not be written down; empty: it was."""


Found = Needs | Run | Rehearsed


@dataclass(slots=True)
class Flown:
    """What is found of a question."""

    needs: Needs = field(default_factory=lambda: Needs({}, {}))
    runs: list[Run] = field(default_factory=list)
    rehearsed: Rehearsed | None = None

    def take(self, one: Found) -> None:
        """Take what is found next."""
        if isinstance(one, Run):
            self.runs.append(one)
        elif isinstance(one, Needs):
            self.needs = one
        else:
            self.rehearsed = one

    @property
    def is_recorded(self) -> bool:
        """Whether the median run was written down, to be watched."""
        return self.rehearsed is not None and not self.rehearsed.trouble


def found(question: Question, recording: Path | None) -> Iterator[Found]:
    """Yield what drones need, and each run; write the median one down, to be watched."""
    yield needs(question)
    runs: list[Run] = []
    for seed in _seeds(question):
        runs.append(run_of(seed, _fly(question, seed)))
        yield runs[-1]
    if recording is not None:
        yield _rehearsed(question, median_of(runs), recording)


def median_of(runs: Iterable[Run]) -> Run:
    """Return the run that is in the middle of those that say how long it takes."""
    ordered = sorted(telling(runs), key=lambda run: (run.seconds, run.seed))
    return ordered[(len(ordered) - 1) // 2]


def telling(runs: Iterable[Run]) -> list[Run]:
    """Return the runs that say how long it takes: those that completed all, if there are such."""
    every = list(runs)
    return [run for run in every if run.whole] or every


def run_of(seed: int, outcome: SimulationResult) -> Run:
    """Return what is kept of a run."""
    ended = {
        str(event["mission"]): event
        for event in outcome.events
        if event["event"] == "mission.ended"
    }
    ends = {
        one.name: End(
            at=float(str(ended[one.name]["t"])) if one.name in ended else None,
            completed=one.status is COMPLETED,
            late=one.late,
            reason=one.reason,
        )
        for one in outcome.missions
    }
    levels = [level for event in outcome.events if isinstance(level := event.get("battery"), float)]
    return Run(
        seed=seed,
        seconds=outcome.duration,
        ends=ends,
        battery=min(levels, default=None),
        given_up=outcome.given_up,
    )


def _seeds(question: Question) -> Iterator[int]:
    """Yield seeds until enough has been flown."""
    since = time.monotonic()
    for place in range(question.runs or MOST):
        passed = time.monotonic() - since
        if place and passed > LONGEST:
            return
        enough = time.process_time() > ENOUGH or passed > PATIENCE
        if question.runs is None and place >= FEWEST and place % 2 and enough:
            return
        yield question.seed + place


def _fly(
    question: Question,
    seed: int,
    sampling: Sampling | None = None,
    hear: Rehearsal | None = None,
) -> SimulationResult:
    return simulate(
        question.app,
        [fresh(mission) for mission in question.all],  # a run changes its missions
        question.flown,
        seed=seed,
        faults=question.faults,
        until=question.until,
        on_event=hear.take if hear is not None else None,
        stands=question.stands,
        sampling=sampling,
    )


def _rehearsed(question: Question, median: Run, recording: Path) -> Rehearsed:
    every = max(SHORTEST, median.seconds / FRAMES)
    try:
        recording.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        rehearsal = Rehearsal(question, recording, every)
        try:
            sampling = Sampling(every=every, look=rehearsal.look)
            outcome = _fly(question, median.seed, sampling, rehearsal)
        finally:
            rehearsal.finish()
    except OSError as error:
        return Rehearsed(Waits(), f"it cannot be written: {error.strerror or error}")
    same = outcome.duration == median.seconds
    return Rehearsed(rehearsal.waits, "" if same else OTHER)


def needs(question: Question) -> Needs:
    """Return what drones need to fly any of the missions at first, where they stand."""
    reach = Reach(question.app, question.fleet.airspace)
    chains = list(_chains(question))[:MOST_CHAINS]
    levels, why = dict[str, float](), dict[str, str]()
    known: dict[tuple[str, Point, Point], float] = {}
    for entry in question.fleet.drones:
        at, _ = question.stands.get(entry.id, (entry.home, 1.0))
        kind = question.kind(entry.id)
        place = entry.category, entry.home, at
        if place not in known:
            every = (reach.level(kind, entry.home, at, chain) for chain in chains)
            known[place] = min(every, default=inf)
        levels[entry.id] = level = known[place]
        if level > 1.0 and chains:
            where = question.fleet.airspace, kind, entry.home
            misses = (miss_of(question.app, *where, chain) for chain in chains)
            some = [miss for miss in misses if miss is not None]
            if len(some) == len(chains):
                nearest = min(some, key=lambda miss: (-miss.lacks, miss.by))
                why[entry.id] = nearest.reason
                if nearest.lacks is Lacks.ACTION and _may_follow(question, kind):
                    del levels[entry.id]  # it is there for what comes later
    return Needs(levels, why)


def _may_follow(question: Question, kind: Category) -> bool:
    """Return whether drones of a category can do what comes later: trips of the plan, or what an evaluator sends for."""
    later = {trip.action for mission in question.missions for trip in mission.trips}
    return any(map(kind.can, question.app.actions if question.app.evaluators else later))


def _chains(question: Question) -> Iterator[list[Trip]]:
    """Yield the different trips with which missions begin."""
    seen = set[object]()
    for mission in question.missions:
        chain = list(chain_of(mission.trips))
        which = tuple((t.action, t.target, t.source, t.item and t.item.mass) for t in chain)
        if chain and which not in seen:
            seen.add(which)
            yield chain
