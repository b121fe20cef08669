"""The control-flow graph of one body: its places, and the ways between them.

The flow outside of all forks is one body, and each branch of a fork is one. Statuses are propagated in each
body separately: a block may be in two of them, with different statuses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from plutoc.block import IN_GRAPH, Gate
from plutoc.check.model import Checked
from plutoc.graph.model import END, Edge
from plutoc.plan.model import Place
from plutoc_runtime.domain.status import WORST_FIRST, Status

Leads = Mapping[Status, tuple[int, "Spot | None", str]]
"""For each status that leaves a spot: the edge's number, the target, and its name."""


Entries = Mapping[str, frozenset[Status]]
"""Blocks at which interrupted missions resume, with their statuses."""
NONE: Entries = {}


class Kind(Enum):
    """What happens at a spot."""

    BLOCK = "the mission goes through a block"
    FORK = "it goes through all branches of a fork, up to the gate"
    BEHIND = "it is behind a gate, with the status that the gate let through"
    ENTERED = "does an interrupted mission go on here?"
    ENTERED_LOOP = "the same, at the head of a loop"
    ARRIVED = "it has come to where it goes on"

    __hash__ = object.__hash__  # members are single: hashing by name is six times slower


@dataclass(frozen=True, slots=True, kw_only=True)
class Spot:
    """A place in a body."""

    kind: Kind
    name: str
    """The block's, or the gate's; for a fork that of the block before it."""
    branches: tuple[Edge, ...] = field(default=(), hash=False)  # a fork may have thousands
    gate: str = ""
    copy: int = 0
    """Counts the places that the source has once and that are written more than once."""

    @property
    def original(self) -> Spot:
        """The spot that it is a copy of, or itself."""
        return replace(self, copy=0) if self.copy else self


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """An edge from a spot to the next, or out of the body."""

    statuses: tuple[Status, ...]
    """In declared order."""
    target: Spot | None
    """None: the end of the mission or the branch."""
    to: str
    """The target's name for people."""
    asked: tuple[Status, ...] = ()
    """What the source says that leads there, whether it can come or not; empty: all that comes."""
    places: tuple[Place, ...] = ()
    """The places of interruption for which it is taken; empty: it depends on the status."""


NO_TRIP_LEFT = Way(statuses=(Status.FAILED,), target=None, to=END)
"""Leaves a block in which every mission ends."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """A body as a control-flow graph."""

    entry: Spot
    ways: Mapping[Spot, tuple[Way, ...]]
    """In the order of discovery; the ways of a spot in the order of the source."""
    arrives: Mapping[Spot, frozenset[Status]]
    exits: frozenset[Status]


class Charts:
    """Makes the charts of one graph, and caches the outcome of each branch."""

    def __init__(self, checked: Checked) -> None:
        self.checked = checked
        self.forks = {(fork.node, fork.status): fork for fork in checked.forks}
        self.numbers = {edge: number for number, edge in enumerate(checked.graph.edges)}
        self.brought: dict[tuple[Edge, Status], frozenset[Status]] = {}

    def chart(self, entry: str, statuses: frozenset[Status], entries: Entries = NONE) -> Chart:
        """Return the body that begins at a block with these statuses, and has further entries."""
        first = Spot(kind=Kind.BLOCK, name=entry)
        queue = [
            (Spot(kind=Kind.BLOCK, name=name), status)
            for name, some in ((entry, statuses), *entries.items())
            for status in IN_GRAPH
            if status in some
        ]
        known = set(queue)
        exits: set[Status] = set()
        found: dict[Spot, dict[Status, tuple[int, Spot | None, str]]] = {}
        arrives: dict[Spot, set[Status]] = {}
        for spot, status in queue:
            arrives.setdefault(spot, set()).add(status)
            found.setdefault(spot, {})
            for leaving in self.after(spot, status):
                number, target, to = self.follow(spot, leaving)
                found[spot][leaving] = (number, target, to)
                if target is None:
                    exits.add(leaving)
                elif (target, leaving) not in known:
                    known.add((target, leaving))
                    queue.append((target, leaving))
        ways: Mapping[Spot, tuple[Way, ...]] = {
            spot: _ways(leads, self.asked(spot, leads)) if leads else (NO_TRIP_LEFT,)
            for spot, leads in found.items()
        }
        created = [name for name in entries if self.checked.graph.node[name].block.creates]
        if created:
            first, ways = _created(first, created, entries, ways)
        return Chart(
            entry=first,
            ways=ways,
            arrives={spot: frozenset(statuses) for spot, statuses in arrives.items()},
            exits=frozenset(exits),
        )

    def after(self, spot: Spot, status: Status) -> tuple[Status, ...]:
        """Return the statuses with which a mission can leave a spot, in declared order."""
        if spot.kind is Kind.FORK:
            left = self.passing(spot, status)
        else:
            emitted = self.checked.graph.node[spot.name].emitted(status)
            left = emitted & self.checked.leaves[spot.name]
        return tuple(s for s in IN_GRAPH if s in left)

    def follow(self, spot: Spot, status: Status) -> tuple[int, Spot | None, str]:
        """Return the successor for a status: the edge's number, the target, and its name."""
        if spot.kind is Kind.FORK:
            return 0, Spot(kind=Kind.BEHIND, name=spot.gate), spot.gate
        graph = self.checked.graph
        if (fork := self.forks.get((spot.name, status))) is not None:
            target = Spot(kind=Kind.FORK, name=fork.node, branches=fork.branches, gate=fork.gate)
            to = f"[{', '.join(edge.target for edge in fork.branches)}]"
            return self.numbers[fork.branches[0]], target, to
        for edge in graph.outgoing[spot.name]:
            if status in self.checked.carries[edge]:
                return self.numbers[edge], self.entered(edge), edge.target
        return len(self.numbers), None, END

    def asked(self, spot: Spot, leads: Leads) -> Mapping[Spot | None, frozenset[Status]]:
        """Return the statuses that the source leads to each target, also impossible ones."""
        edges = self.checked.graph.outgoing[spot.name]
        if spot.kind is Kind.FORK or (len(edges) == 1 and edges[0].guard is None):
            return {}
        found = {
            target: {s for s in leads if leads[s][1] == target} for _, target, _ in leads.values()
        }
        for status in IN_GRAPH:
            takers = [edge for edge in edges if status in edge.takes]
            if status not in leads and len(takers) == 1:
                target = self.entered(takers[0])
                if target in found:
                    found[target].add(status)
        return {target: frozenset(statuses) for target, statuses in found.items()}

    def entered(self, edge: Edge) -> Spot | None:
        """Return the spot that an edge leads to; in a branch a gate is the end."""
        # behind the gate the outer body continues
        out = edge.target == END or self.checked.graph.node[edge.target].block.gate is not None
        return None if out else Spot(kind=Kind.BLOCK, name=edge.target)

    def passing(self, fork: Spot, status: Status) -> frozenset[Status]:
        """Return what the gate lets through when missions fork with this status."""
        brought = [self.brings(edge, status) for edge in fork.branches]
        return let_through(self.checked.graph.node[fork.gate].block.gate, brought)

    def brings(self, edge: Edge, status: Status) -> frozenset[Status]:
        """Return the statuses with which one branch arrives at its gate."""
        if self.checked.graph.node[edge.target].block.gate is not None:
            return frozenset((status,))
        if (edge, status) not in self.brought:
            self.brought[edge, status] = self.chart(edge.target, frozenset((status,))).exits
        return self.brought[edge, status]


def _created(
    first: Spot, created: Sequence[str], entries: Entries, ways: Mapping[Spot, tuple[Way, ...]]
) -> tuple[Spot, Mapping[Spot, tuple[Way, ...]]]:
    """Ask before all else whether an event has made the mission; return where, and all ways."""
    question = Spot(kind=Kind.ENTERED, name=first.name)
    others = (None, *(name for name in entries if name not in created))
    asked = [Way(statuses=(), target=first, to=first.name, places=others)]
    for name in created:
        target = Spot(kind=Kind.BLOCK, name=name)
        asked.append(Way(statuses=(), target=target, to=name, places=(name,)))
    return question, {question: tuple(asked), **ways}


def _ways(leads: Leads, asked: Mapping[Spot | None, frozenset[Status]]) -> tuple[Way, ...]:
    """Return one way for each target, for all its statuses and edges."""
    targets: dict[Spot | None, tuple[int, str]] = {}
    for number, target, to in sorted(leads.values(), key=lambda lead: lead[0]):
        targets.setdefault(target, (number, to))
    return tuple(
        Way(
            statuses=tuple(s for s in IN_GRAPH if s in leads and leads[s][1] == target),
            target=target,
            to=to,
            asked=tuple(s for s in IN_GRAPH if s in asked.get(target, ())),
        )
        for target, (_, to) in targets.items()
    )


def let_through(gate: Gate | None, brought: Sequence[frozenset[Status]]) -> frozenset[Status]:
    """Return what a gate can pass on, given what each branch of the fork can bring."""
    some = frozenset[Status]().union(*brought)
    if gate is not Gate.ALL:
        return some
    # at best, every branch brings the best that it can: nothing better than that passes
    floor = min(max(map(WORST_FIRST.index, statuses), default=-1) for statuses in brought)
    return frozenset(s for s in some if WORST_FIRST.index(s) <= floor)
