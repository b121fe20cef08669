"""One graph, flown plain and optimised in several worlds; and many graphs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from random import Random

from plutoc.block import IN_GRAPH
from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.compile import planned
from plutoc.diagnostic import Rejected, accept_or_raise
from plutoc.graph.resolve import resolved
from plutoc.plan.errors import BadPlan
from plutoc.plan.model import Plan
from plutoc.plan.optimise import stages
from plutoc.plan.verify import verify
from plutoc.registry import STD, Blocks, blocks_of
from plutoc.source import Source
from plutoc.syntax.parse import read
from tests.equivalence import coverage
from tests.equivalence.flows import Package, packaged
from tests.equivalence.fly import Record, difference, record
from tests.equivalence.worlds import TIMES, World, random_world
from tests.kit.graphs import others
from tests.kit.graphs.graph import random_source
from tests.kit.shrink import shrunk, simpler, smaller_sources

WORLDS = 3
"""For each graph. What is learnt in one about how long trips take is used in the next."""

INSTALLED = Blocks(
    packages=(STD, others.PACKAGE),
    of=lambda name: others.BLOCKS if name == others.PACKAGE else blocks_of(name),
)
Planner = Callable[[Checked], Plan]
plainly: Planner = partial(planned, optimise=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A graph that leaves two traces."""

    name: str
    """`SEED/NUMBER`: with `--only` it is drawn once more."""
    text: str
    world: World | None
    """None: it is not even a plan."""
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
    luck = Random(f"{name}/events")
    events = luck if luck.random() < 0.5 else None
    for refused in range(1000):
        text = random_source(rng, events=events)
        checked = sound(text)
        if checked is not None:
            return text, checked, rng, refused
    raise AssertionError(f"no sound graph in a thousand, by the seed {name}")


def sound(text: str) -> Checked | None:
    """Return the checked graph of a source; None where it is refused."""
    file, found = read(Source(path="app.pluto", text=text))
    graph, more = resolved(file, INSTALLED)
    try:
        accept_or_raise((*found, *more))
        return check(graph)[0]
    except Rejected:
        return None


def blamed(finding: Finding) -> str:
    """Name the first pass after which there is a difference."""
    checked = sound(finding.text)
    assert checked is not None
    if finding.world is None:
        return "the one that is named"
    stage = list(stages(plainly(checked)))
    wanted = record(packaged(stage[0][1]), finding.world)
    for name, plan in stage[1:]:
        if difference(wanted, record(packaged(plan), finding.world)) is not None:
            return name
    return "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """A graph, and how its plain package flies: what others are held against."""

    text: str
    checked: Checked
    refused: int
    plain: Plan
    flights: Sequence[tuple[World, Record]]


@lru_cache(maxsize=150)
def reference(name: str) -> Reference:
    """Draw a graph and fly it; who asks once more finds the same."""
    text, checked, rng, refused = drawn(name)
    plain = plainly(checked)
    flights = tuple(_worlds(packaged(plain), checked, rng))
    return Reference(text=text, checked=checked, refused=refused, plain=plain, flights=flights)


def one_graph(name: str, planner: Planner = planned) -> Tally:
    """Draw a graph and hold the package of a planner against the plain package in all its worlds."""
    known = reference(name)
    text, other = known.text, planner(known.checked)
    tally = Tally(graphs=1, refused=known.refused)
    tally.seen.update(coverage.of_graph(known.plain, other))
    if planner is planned:
        tally.findings += _malformed(name, text, known.plain)
    package = packaged(other)
    for world, plainly_flown in known.flights:
        said = difference(plainly_flown, record(package, world))
        if plainly_flown.broken:
            said = f"the plain package broke: {plainly_flown.ends[0]}"
        tally.flights += 1
        tally.events += len(plainly_flown.events)
        tally.seen.update(coverage.of_run(world, plainly_flown))
        if said is not None:
            tally.findings.append(Finding(name=name, text=text, world=world, said=said))
    return tally


def _malformed(name: str, text: str, plain: Plan) -> Iterator[Finding]:
    """Yield each pass after which a plan is none any more."""
    for after, plan in stages(plain):
        try:
            verify(plan)
        except BadPlan as bad:
            yield Finding(name=name, text=text, world=None, said=f"after the pass {after}: {bad}")


def _worlds(plain: Package, checked: Checked, rng: Random) -> Iterator[tuple[World, Record]]:
    times: Sequence[float] = TIMES
    for _ in range(WORLDS):
        world = random_world(rng, plain.graph, times)
        flown = record(plain, world)
        times = (*flown.lengths, *flown.lengths, *TIMES) if flown.lengths else TIMES
        yield world, flown
    for place, statuses in checked.entries.items():
        for status in IN_GRAPH:
            if status in statuses:
                entered = replace(world, entry=(place, status))
                yield entered, record(plain, entered)


def differs(text: str, world: World) -> str | None:
    """Return the first difference of a source in a world, if it is sound and there is one."""
    checked = sound(text)
    if checked is None:
        return None
    plain = record(packaged(plainly(checked)), world)
    return difference(plain, record(packaged(planned(checked)), world))


def smallest(finding: Finding) -> Finding:
    """Return a smaller source and world that leave two traces all the same."""
    if finding.world is None:
        return finding
    said = [finding.said]

    def smaller(case: tuple[str, World]) -> Iterator[tuple[str, World]]:
        text, world = case
        yield from ((text, each) for each in simpler(world))
        yield from ((each, world) for each in smaller_sources(text))

    def shows(case: tuple[str, World]) -> bool:
        try:
            found = differs(*case)
        except (TypeError, KeyError, AttributeError):  # the world speaks of what is no more
            return False
        if found is not None:
            said.append(found)
        return found is not None

    text, world = shrunk((finding.text, finding.world), smaller, shows)
    return replace(finding, text=text, world=world, said=said[-1])
