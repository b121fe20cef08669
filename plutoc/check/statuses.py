"""Explore every state that a mission can be in, until nothing new turns up.

A state is a block, a status, the innermost branch that a clone is in, and facts about its past. All that the
branches of a fork share is the outcome of the trip in flight, which is chosen at the launch. Given that, they
are independent, so what passes a gate depends only on what each of them can bring: no product of branches is
built, forks may nest, and the exploration is exact for any number of branches.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

import networkx as nx

from plutoc.block import Gate
from plutoc.check import errors, fork_errors, gate_outcomes
from plutoc.check.facts import (
    elsewhere,
    is_over,
    leaving,
    puts_trips,
    says_the_same,
    unless_failed,
)
from plutoc.check.flow import Facts, Flow, Fork, Frame, Place, Split, Step
from plutoc.check.forks import MOST_NESTED
from plutoc.diagnostic import Rejected
from plutoc.graph.digraph import endless_loops, loops, reachable, subgraph
from plutoc.graph.model import END, Edge, Graph
from plutoc_runtime.domain.status import Status

Places = dict[Place, None]
"""An ordered set."""
MOST_PLACES, MOST_STEPS = 200_000, 1_000_000
"""The limits of the exploration: places, and steps between them. A usual app has about as many places as
blocks, and as many steps as edges."""


def explore(
    graph: Graph,
    edges: tuple[Edge, ...],
    beginnings: Iterable[Place],
    *,
    idle: Collection[str] = (),
    barred: Collection[Fork] = (),
) -> Flow:
    """Explore all places of missions from these on, along these edges.

    With `idle` blocks, only as long as they stay there with nothing left to fly and no hook fails
    them. Nothing behind `barred` forks is explored. Raises `Rejected` beyond the limits.
    """
    arrows = arrows_of(graph, edges)
    rounds = unflown(graph, arrows)
    asked = [name for name in rounds if says_the_same(graph.node[name])]
    walk = _Walk(
        graph=graph,
        edges=edges,
        arrows=arrows,
        rounds=rounds,
        numbers={name: number for number, name in enumerate(asked)},
        hooked=_hooked(graph, arrows),
        breaking=_breaking(graph, arrows),
        idle=idle,
        barred=barred,
    )
    walk.run(beginnings)
    return walk.flow()


def arrows_of(graph: Graph, edges: Iterable[Edge]) -> nx.DiGraph:
    """Return which block some edges lead to from which, by name; `start` and `end` among them."""
    arrows = nx.DiGraph()
    arrows.add_nodes_from(graph.node)
    arrows.add_edges_from((edge.source, edge.target) for edge in edges)
    return arrows


def unflown(graph: Graph, arrows: nx.DiGraph) -> Mapping[str, int]:
    """Return the blocks of loops without flights; those of one loop have one number.

    There the answers of blocks are remembered. Nearly every loop of an app has a launch, so these
    are few.
    """
    parts = loops(_without_launches(graph, arrows))
    return {name: number for number, part in enumerate(parts, 1) for name in part}


def _without_launches(graph: Graph, arrows: nx.DiGraph) -> nx.DiGraph:
    return subgraph(arrows, (node.name for node in graph.nodes if not node.block.launches))


def _hooked(graph: Graph, arrows: nx.DiGraph) -> frozenset[Edge]:
    hooks = [node.name for node in graph.nodes if puts_trips(node)]
    lead_there = reachable(_without_launches(graph, arrows).reverse(copy=False), hooks)
    return frozenset(
        edge
        for node in graph.nodes
        for edge in graph.outgoing[node.name]
        if edge.target in lead_there
        and any(
            edge.takes & other.takes for other in graph.outgoing[node.name] if other is not edge
        )
    )


def _breaking(graph: Graph, arrows: nx.DiGraph) -> frozenset[str]:
    """Return the blocks that launch flights which an event may break off."""
    launching = [node.name for node in graph.nodes if node.block.launches]
    breaks = {node.name for node in graph.nodes if node.block.interrupts}
    if not breaks:
        return frozenset()
    onward = nx.restricted_view(arrows, [], [edge for edge in arrows.edges if edge[1] in launching])
    return frozenset(name for name in launching if breaks & reachable(onward, [name]))


def stop_if_tangled(graph: Graph, places: int, steps: int = 0) -> None:
    """Raise `Rejected` beyond the limits of the exploration."""
    if places > MOST_PLACES or steps > MOST_STEPS:
        raise Rejected([errors.too_tangled(graph, MOST_PLACES, MOST_STEPS)])


def creation(creator: str) -> Place:
    """Return the place where missions are created."""
    return Place(frame=None, node=creator, status=Status.UNEXECUTED, facts=Facts())


@dataclass(slots=True, kw_only=True, eq=False)
class _Walk:
    """The exploration in progress. Dicts are used as sets with a deterministic order."""

    graph: Graph
    edges: tuple[Edge, ...]
    arrows: nx.DiGraph
    rounds: Mapping[str, int]
    """Blocks that can be reached twice without a flight, with the loop of each."""
    numbers: Mapping[str, int]
    """Those of them that repeat their answers."""
    hooked: frozenset[Edge]
    """The first edges of the branches in which a hook may put another trip first."""
    breaking: frozenset[str]
    """The blocks that launch flights which an event may break off."""
    idle: Collection[str]
    """If given, missions that leave these blocks, or have something to fly, are not explored."""
    barred: Collection[Fork]
    hasty: dict[Split, None] = field(default_factory=dict)
    """Forks whose gate does not wait for a branch that never arrives."""
    outgoing: dict[str, list[Edge]] = field(default_factory=dict)
    steps: int = 0
    depths: dict[Split, int] = field(default_factory=dict)
    """How deep each fork lies in others, itself included, on the shortest way to it."""
    widths: dict[Split, int] = field(default_factory=dict)
    queue: deque[Place] = field(default_factory=deque)
    places: dict[Place, Step | None] = field(default_factory=dict)
    after: nx.DiGraph = field(default_factory=nx.DiGraph)
    loose: dict[tuple[Place, Status], None] = field(default_factory=dict)
    entries: dict[Split, Places] = field(default_factory=dict)
    closes: dict[Split, dict[str, dict[int, Places]]] = field(default_factory=dict)
    through: dict[Split, dict[str, dict[gate_outcomes.Passing, Place]]] = field(
        default_factory=dict
    )
    """What has passed each fork's gates, with the arrival that brought it."""
    waiting: dict[Split, None] = field(default_factory=dict)
    """Forks with a clone at a gate that nothing has passed yet."""
    strays: dict[Split, Places] = field(default_factory=dict)
    arrives: dict[str, set[Status]] = field(default_factory=dict)
    leaves: dict[str, set[Status]] = field(default_factory=dict)
    carries: dict[Edge, set[Status]] = field(default_factory=dict)

    def run(self, beginnings: Iterable[Place]) -> None:
        for edge in self.edges:
            self.outgoing.setdefault(edge.source, []).append(edge)
            if edge.source in self.graph.sources:
                self.carries[edge] = {Status.UNEXECUTED}
        for place in beginnings:
            self.places[place] = None
            self.after.add_node(place)
            self.queue.append(place)
        while self.queue:
            while self.queue:
                self.visit(self.queue.popleft())
                stop_if_tangled(self.graph, len(self.places), self.steps)
            self.stop_waiting()
        self.join_at_gates()

    def visit(self, place: Place) -> None:
        self.arrives.setdefault(place.node, set()).add(place.status)
        if place.node == END:
            return
        if self.idle and not (place.node in self.idle and is_over(place)):
            return
        node = self.graph.node[place.node]
        if place.frame is not None and not place.out:
            if node.block.gate is not None:
                self.close(place, place.frame, node.block.gate)
                return
            if node.block.allocates or node.block.launches:
                self.stray(place, place.frame.split)
                return
        breaks = place.node in self.breaking
        ways = tuple(leaving(node, place, self.numbers.get(place.node), breaks=breaks))
        for status, facts in unless_failed(ways) if self.idle else ways:
            self.leave(place, status, facts)

    def reach(self, place: Place, step: Step) -> None:
        if self.idle and self.rounds.get(place.node) != self.rounds.get(step.before.node):
            place = place._replace(node=END)  # what follows on another loop is explored there
        self.after.add_edge(step.before, place)
        self.steps += 1
        if place not in self.places:
            self.places[place] = step
            self.queue.append(place)

    def leave(self, place: Place, status: Status, facts: Facts) -> None:
        """Follow the edges that take the status: one routes, several fork."""
        self.leaves.setdefault(place.node, set()).add(status)
        taken = [e for e in self.outgoing.get(place.node, ()) if status in e.takes]
        for edge in taken:
            self.carries.setdefault(edge, set()).add(status)
        if not taken:
            self.loose[place, status] = None
        elif len(taken) == 1:
            if self.rounds.get(place.node) != self.rounds.get(taken[0].target):
                facts = elsewhere(facts)
            target = Place(frame=place.frame, node=taken[0].target, status=status, facts=facts)
            self.reach(target, Step(before=place, leaving=status))
        else:
            turns = self.rounds.get(place.node)
            if all(self.rounds.get(edge.target) != turns for edge in taken):
                facts = elsewhere(facts)
            split = Split(node=place.node, status=status, facts=facts)
            self.nest(split, place.frame)
            self.entries.setdefault(split, {})[place] = None
            if split.fork in self.barred:
                self.after.add_edge(place, place._replace(node=END))  # it goes on, unseen
                return
            for branch, edge in enumerate(taken):
                frame = Frame(split=split, branch=branch)
                target = Place(frame=frame, node=edge.target, status=status, facts=facts)
                self.reach(target, Step(before=place, leaving=status, enters=True))
            # others have forked here before: what passed their gate holds for this mission, too
            for gate in tuple(self.through.get(split, {}).values()):
                for passed, arrival in tuple(gate.items()):
                    self.go_on(arrival, passed, place)
            for lost in tuple(self.strays.get(split, ())):
                self.go_on(lost, (lost.status, lost.facts), place)

    def nest(self, split: Split, frame: Frame | None) -> None:
        """Raise `Rejected` where a fork begins too deep in others: the longer they go on, the longer all takes."""
        depth = self.depths.setdefault(split, self.depths[frame.split] + 1 if frame else 1)
        if depth > MOST_NESTED:
            raise Rejected([fork_errors.too_deep(self.graph, split.fork, MOST_NESTED)])

    def close(self, place: Place, frame: Frame, gate: Gate) -> None:
        """Process a clone that arrives at the gate of its fork."""
        branches = self.closes.setdefault(frame.split, {}).setdefault(place.node, {})
        branches.setdefault(frame.branch, {})[place] = None
        passed = self.through.get(frame.split, {}).get(place.node, {})
        known = (place.status, place.facts) in passed
        if gate is Gate.ALL or not known:  # the second to bring the same changes nothing
            self.let_through(frame.split, place.node, gate)

    def let_through(self, split: Split, name: str, gate: Gate) -> None:
        """Continue missions behind a gate, given the arrivals so far."""
        passed = self.through.setdefault(split, {}).setdefault(name, {})
        for what, arrival in self.passing(split, gate, self.closes[split][name]).items():
            if what not in passed:
                passed[what] = arrival
                for entry in tuple(self.entries[split]):
                    self.go_on(arrival, what, entry)
        if any(self.through[split].values()):
            self.waiting.pop(split, None)
        else:
            self.waiting[split] = None

    def passing(
        self, split: Split, gate: Gate, branches: dict[int, Places]
    ) -> dict[gate_outcomes.Passing, Place]:
        """Return what passes a gate, given what each branch has brought so far."""
        if gate is Gate.ALL and len(branches) < self.width(split) and split not in self.hasty:
            return {}
        passing = gate_outcomes.passing(gate, branches)
        for branch, arrivals in branches.items() if self.hooked else ():
            if self.forgets_beside(split, branch):
                for arrival in arrivals:
                    if (arrival.status, arrival.facts) in passing:
                        forgotten = arrival.facts._replace(attempts=0)
                        passing.setdefault((arrival.status, forgotten), arrival)
        return passing

    def forgets_beside(self, split: Split, branch: int) -> bool:
        """Whether a hook of any other branch may put another trip first while this one waits."""
        own = [edge for edge in self.outgoing[split.node] if split.status in edge.takes][branch]
        return not self.hooked <= {own}

    def go_on(self, arrival: Place, what: gate_outcomes.Passing, entry: Place) -> None:
        """Leave the branch where the clone has arrived; the mission continues from there."""
        target = self.beyond(arrival, what, entry)
        self.reach(target, Step(before=arrival, leaving=None, back_to=entry))

    def beyond(self, arrival: Place, what: gate_outcomes.Passing, entry: Place) -> Place:
        """Return the place of the mission behind the gate."""
        status, facts = what
        return Place(frame=entry.frame, node=arrival.node, status=status, facts=facts, out=True)

    def join_at_gates(self) -> None:
        """Connect every clone at a gate with everything that passes together with it.

        So far only the clone that brings a status does; but the others do not end here.
        """
        for split, gates in self.closes.items():
            for name, branches in gates.items():
                passed: dict[Status, list[tuple[gate_outcomes.Passing, Place]]] = {}
                for what, bringer in self.through[split][name].items():
                    passed.setdefault(what[0], []).append((what, bringer))
                for arrival, status in gate_outcomes.with_each(self.gate(name), branches):
                    for what, bringer in passed.get(status, ()):
                        for entry in self.entries[split]:
                            self.after.add_edge(arrival, self.beyond(bringer, what, entry))
                            self.steps += 1
                    stop_if_tangled(self.graph, len(self.places), self.steps)

    def stray(self, place: Place, split: Split) -> None:
        """Process a clone that is flown before its gate, an error, as if its branch ended here."""
        self.strays.setdefault(split, {})[place] = None
        for entry in tuple(self.entries[split]):
            self.go_on(place, (place.status, place.facts), entry)

    def width(self, split: Split) -> int:
        if split not in self.widths:
            self.widths[split] = sum(split.status in e.takes for e in self.outgoing[split.node])
        return self.widths[split]

    def stop_waiting(self) -> None:
        """Release gates that wait in vain, which would hide everything behind them."""
        for split in tuple(self.waiting):
            self.hasty[split] = None
            for name in self.closes[split]:
                self.let_through(split, name, self.gate(name))

    def gate(self, name: str) -> Gate:
        gate = self.graph.node[name].block.gate
        assert gate is not None, "only a gate closes a branch"
        return gate

    def flow(self) -> Flow:
        left = {place for place, _ in self.loose}
        return Flow(
            graph=self.graph,
            edges=self.edges,
            places=self.places,
            arrows=self.arrows,
            after=self.after,
            loose=tuple(self.loose),
            endless=tuple(one for one in endless_loops(self.after) if left.isdisjoint(one)),
            entries={split: tuple(entries) for split, entries in self.entries.items()},
            nearest={place.node: place for place in reversed(self.places)},
            arrives={name: frozenset(self.arrives.get(name, ())) for name in self._names()},
            leaves={name: frozenset(self.leaves.get(name, ())) for name in self.graph.node},
            carries={edge: frozenset(self.carries.get(edge, ())) for edge in self.graph.edges},
        )

    def _names(self) -> tuple[str, ...]:
        return (*self.graph.node, END)
