"""Walk the graph with every status until nothing new turns up: a monotone fixpoint.

The walk keeps, beside block and status, the innermost branch that a clone is in and what the
mission has behind it. So a gate gives back to a mission just what its own branches brought, forks
may nest, and a loop with forks in it stays small: no stack of branches is ever unrolled.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

from plutoc.block import Block, Gate
from plutoc.check.flow import Facts, Flow, Fork, Frame, Place, Split, Step, ordered
from plutoc.graph.model import END, START, Edge, Graph
from plutoc_runtime.status import WORST_FIRST, Status

Places = dict[Place, None]
"""An ordered set."""


def explore(graph: Graph, creator: str, edges: tuple[Edge, ...]) -> Flow:
    """Return where missions can be, from the creator on, along these edges.

    A gate that waits for a branch that never arrives would hide all that is behind it. Such gates
    are found first, and then walked as if they did not wait: one mistake, one message.
    """
    hasty: frozenset[Fork] = frozenset()
    while True:
        walk = _Walk(graph=graph, edges=edges, hasty=hasty)
        walk.run(creator)
        stuck = hasty | walk.waiting()
        if stuck == hasty:
            return walk.flow()
        hasty = stuck


@dataclass(kw_only=True)
class _Walk:
    """The walk while it goes on. Dicts stand in for sets: their order is certain."""

    graph: Graph
    edges: tuple[Edge, ...]
    hasty: frozenset[Fork]
    """Forks whose gate does not wait for branches that do not arrive."""
    outgoing: dict[str, list[Edge]] = field(default_factory=dict)
    queue: deque[Place] = field(default_factory=deque)
    places: dict[Place, Step | None] = field(default_factory=dict)
    after: dict[Place, Places] = field(default_factory=dict)
    loose: dict[tuple[Place, Status], None] = field(default_factory=dict)
    entries: dict[Split, Places] = field(default_factory=dict)
    closes: dict[Split, dict[str, dict[int, Places]]] = field(default_factory=dict)
    through: dict[Split, dict[tuple[str, Status], Place]] = field(default_factory=dict)
    """What each fork's gate has let through, and the arrival that brought it."""
    strays: dict[Split, Places] = field(default_factory=dict)
    arrives: dict[str, set[Status]] = field(default_factory=dict)
    leaves: dict[str, set[Status]] = field(default_factory=dict)
    carries: dict[Edge, set[Status]] = field(default_factory=dict)

    def run(self, creator: str) -> None:
        for edge in self.edges:
            self.outgoing.setdefault(edge.source, []).append(edge)
            if edge.source == START:
                self.carries[edge] = {Status.UNEXECUTED}
        first = Place(frame=None, node=creator, status=Status.UNEXECUTED, facts=Facts())
        self.places[first] = None
        self.queue.append(first)
        while self.queue:
            self.visit(self.queue.popleft())

    def visit(self, place: Place) -> None:
        self.arrives.setdefault(place.node, set()).add(place.status)
        if place.node == END:
            return
        node = self.graph.node[place.node]
        if place.frame is not None and not place.out:
            if node.block.gate is not None:
                self.close(place, place.frame, node.block.gate)
                return
            if node.block.allocates or node.block.launches:
                self.stray(place, place.frame.split)
                return
        facts = _behind(node.block, place.facts)
        for status in ordered(node.emitted(place.status)):
            self.leave(place, status, facts)

    def reach(self, place: Place, step: Step) -> None:
        self.after.setdefault(step.before, {})[place] = None
        if place not in self.places:
            self.places[place] = step
            self.queue.append(place)

    def leave(self, place: Place, status: Status, facts: Facts) -> None:
        """Go on along the edges that take the status: one routes, several fork."""
        self.leaves.setdefault(place.node, set()).add(status)
        taken = [e for e in self.outgoing.get(place.node, ()) if status in e.takes]
        for edge in taken:
            self.carries.setdefault(edge, set()).add(status)
        if not taken:
            self.loose[place, status] = None
        elif len(taken) == 1:
            target = Place(frame=place.frame, node=taken[0].target, status=status, facts=facts)
            self.reach(target, Step(before=place, leaving=status))
        else:
            split = Split(node=place.node, status=status, facts=facts)
            self.entries.setdefault(split, {})[place] = None
            for branch, edge in enumerate(taken):
                frame = Frame(split=split, branch=branch)
                target = Place(frame=frame, node=edge.target, status=status, facts=facts)
                self.reach(target, Step(before=place, leaving=status, enters=True))
            # others forked here before: their gate's findings hold for this mission too
            for (_, passed), arrival in tuple(self.through.get(split, {}).items()):
                self.go_on(arrival, passed, place)
            for lost in tuple(self.strays.get(split, ())):
                self.go_on(lost, lost.status, place)

    def close(self, place: Place, frame: Frame, gate: Gate) -> None:
        """A clone arrives at the gate of its fork."""
        branches = self.closes.setdefault(frame.split, {}).setdefault(place.node, {})
        branches.setdefault(frame.branch, {})[place] = None
        passed = self.through.setdefault(frame.split, {})
        for status, arrival in self.passing(frame.split, gate, branches).items():
            if (place.node, status) not in passed:
                passed[place.node, status] = arrival
                for entry in tuple(self.entries[frame.split]):
                    self.go_on(arrival, status, entry)

    def passing(self, split: Split, gate: Gate, branches: dict[int, Places]) -> dict[Status, Place]:
        """Return what a gate lets through, given what each branch has brought so far."""
        brought: dict[Status, Place] = {}
        for arrivals in branches.values():
            for arrival in arrivals:
                brought.setdefault(arrival.status, arrival)
        if gate is Gate.FIRST:
            return brought
        if len(branches) < self.width(split) and split.fork not in self.hasty:
            return {}
        # at best, every branch brings the best that it can: nothing better than that passes
        floor = min(max(_goodness(a.status) for a in arrivals) for arrivals in branches.values())
        return {s: place for s, place in brought.items() if _goodness(s) <= floor}

    def go_on(self, arrival: Place, status: Status, entry: Place) -> None:
        """The branch is left where the clone has arrived; the mission goes on from there."""
        target = Place(
            frame=entry.frame, node=arrival.node, status=status, facts=arrival.facts, out=True
        )
        self.reach(target, Step(before=arrival, leaving=None, back_to=entry))

    def stray(self, place: Place, split: Split) -> None:
        """A clone is flown before its gate: an error, walked on as if its branch ended here."""
        self.strays.setdefault(split, {})[place] = None
        for entry in tuple(self.entries[split]):
            self.go_on(place, place.status, entry)

    def width(self, split: Split) -> int:
        return sum(split.status in e.takes for e in self.outgoing[split.node])

    def waiting(self) -> frozenset[Fork]:
        """Forks whose gate has let nothing through, for want of a branch."""
        return frozenset(
            split.fork
            for split, gates in self.closes.items()
            for branches in gates.values()
            if len(branches) < self.width(split) and not self.through.get(split)
        )

    def flow(self) -> Flow:
        return Flow(
            graph=self.graph,
            edges=self.edges,
            places=self.places,
            after={place: tuple(self.after.get(place, ())) for place in self.places},
            loose=tuple(self.loose),
            entries={split: tuple(entries) for split, entries in self.entries.items()},
            arrives={name: frozenset(self.arrives.get(name, ())) for name in self._names()},
            leaves={name: frozenset(self.leaves.get(name, ())) for name in self.graph.node},
            carries={edge: frozenset(self.carries.get(edge, ())) for edge in self.graph.edges},
        )

    def _names(self) -> tuple[str, ...]:
        return (*self.graph.node, END)


def _goodness(status: Status) -> int:
    return WORST_FIRST.index(status)


def _behind(block: Block, facts: Facts) -> Facts:
    """What a mission has behind it after a block."""
    if block.launches:
        return Facts(allocated=False, launched=True)
    if block.allocates:
        return Facts(allocated=True, launched=facts.launched)
    return facts
