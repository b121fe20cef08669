"""One graph, flown plain and optimised in several worlds; and many graphs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from random import Random

from plutoc.check.model import Checked
from plutoc.compile import analyse, planned
from plutoc.diagnostic import Rejected
from plutoc.plan.model import Plan
from plutoc.source import Source
from tests.equivalence import coverage
from tests.equivalence.flows import NOTHING, Overrides
from tests.equivalence.fly import Record, difference, record
from tests.equivalence.graphs import random_source
from tests.equivalence.worlds import TIMES, World, random_world

WORLDS = 3
"""For each graph. What is learnt in one about how long trips take is used in the next."""

Planner = Callable[[Checked], Plan]
plainly: Planner = partial(planned, optimise=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Contender:
    """What is held against the plain package."""

    planner: Planner = planned
    overrides: Overrides = field(default_factory=lambda: NOTHING)
    """Functions that its flow gets in place of the runtime's."""


OURS = Contender()


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A graph that leaves two traces."""

    name: str
    """`SEED/NUMBER`: with `--only` it is drawn once more."""
    text: str
    world: World
    said: str
    """The first difference."""

    def __str__(self) -> str:
        return f"graph {self.name}\n{self.text}\n{self.world}\nfirst difference: {self.said}"


@dataclass(slots=True, kw_only=True)
class Tally:
    """What a campaign has come to."""

    graphs: int = 0
    refused: int = 0
    """Sources that were drawn and are not sound."""
    flights: int = 0
    """Runs of the plain package, each with one of the optimised beside it."""
    events: int = 0
    seen: Counter[str] = field(default_factory=Counter)
    """By what it is: in how many graphs, or in how many runs."""
    findings: list[Finding] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        """Count what another part of the campaign has come to."""
        self.graphs += other.graphs
        self.refused += other.refused
        self.flights += other.flights
        self.events += other.events
        self.seen.update(other.seen)
        self.findings += other.findings


def drawn(name: str) -> tuple[str, Checked, Random, int]:
    """Draw a sound graph; return how many were refused before it, too."""
    rng = Random(name)
    for refused in range(1000):
        text = random_source(rng)
        checked = sound(text)
        if checked is not None:
            return text, checked, rng, refused
    raise AssertionError(f"no sound graph in a thousand, by the seed {name}")


def sound(text: str) -> Checked | None:
    """Return the checked graph of a source; None where it is refused."""
    try:
        return analyse(Source(path="app.pluto", text=text))[0]
    except Rejected:
        return None


def one_graph(name: str, contender: Contender = OURS) -> Tally:
    """Draw a graph and hold the contender against the plain package in all its worlds."""
    text, checked, rng, refused = drawn(name)
    plain, other = plainly(checked), contender.planner(checked)
    tally = Tally(graphs=1, refused=refused)
    tally.seen.update(coverage.of_graph(plain, other))
    for world, plainly_flown in _worlds(plain, rng):
        said = difference(plainly_flown, record(other, world, contender.overrides))
        if plainly_flown.broken:
            said = f"the plain package broke: {plainly_flown.ends[0]}"
        tally.flights += 1
        tally.events += len(plainly_flown.events)
        tally.seen.update(coverage.of_run(world, plainly_flown))
        if said is not None:
            tally.findings.append(Finding(name=name, text=text, world=world, said=said))
    return tally


def _worlds(plain: Plan, rng: Random) -> Iterator[tuple[World, Record]]:
    times: Sequence[float] = TIMES
    for _ in range(WORLDS):
        world = random_world(rng, plain.checked.graph, times)
        flown = record(plain, world)
        times = (*flown.lengths, *flown.lengths, *TIMES) if flown.lengths else TIMES
        yield world, flown


def differs(text: str, world: World, contender: Contender = OURS) -> str | None:
    """Return the first difference of a source in a world, if it is sound and there is one."""
    checked = sound(text)
    if checked is None:
        return None
    plain = record(plainly(checked), world)
    return difference(plain, record(contender.planner(checked), world, contender.overrides))


def first_finding(contender: Contender, graphs: int, seed: int = 0) -> Finding | None:
    """Return what shows first that a contender is not the plain package, within so many graphs."""
    for number in range(graphs):
        found = one_graph(f"{seed}/{number}", contender).findings
        if found:
            return found[0]
    return None
