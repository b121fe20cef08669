"""The checks of flights: allocation and launch, handling of failures, evaluation before repetition."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import networkx as nx

from plutoc.check import errors
from plutoc.check.facts import bound_of
from plutoc.check.flow import Flow, Place, Way, blocks_of
from plutoc.check.statuses import arrows_of
from plutoc.diagnostic import Diagnostic
from plutoc.graph.digraph import loops, reachable, round_of
from plutoc.graph.model import Graph, Node
from plutoc_runtime.domain.status import Status

_MOST_SHOWN = 9
"""The most blocks that are shown beside the first."""


def along_nothing(graph: Graph) -> list[Diagnostic]:
    """Find actions that are done on the way where no drone ever flies."""
    if any(node.block.launches for node in graph.nodes):
        return []
    return [errors.along_nothing(graph, action) for action in graph.actions if action.along]


def undrawn(flow: Flow) -> list[Diagnostic]:
    """Find launches without an allocation since the previous launch."""
    return _first(
        flow, lambda node, p: node.block.launches and not p.facts.allocated, errors.no_allocation
    )


def unlaunched(flow: Flow) -> list[Diagnostic]:
    """Find blocks that watch a flight without a launch before."""
    return _first(
        flow, lambda node, p: node.block.watches and not p.facts.launched, errors.no_launch
    )


def held(flow: Flow) -> list[Diagnostic]:
    """Warn of missions that wait with an allocated drone that no other mission can use."""
    return _first(flow, lambda node, p: node.block.holds and p.facts.allocated, errors.drone_held)


def _first(
    flow: Flow,
    wrong: Callable[[Node, Place], bool],
    error: Callable[[Graph, Node, Way], Diagnostic],
) -> list[Diagnostic]:
    """Report each wrong block, with the shortest path that shows it."""
    found: dict[str, Diagnostic] = {}
    for place in flow.places:
        node = flow.graph.node.get(place.node)
        # a clone that was flown before its gate has its own message
        if node and not place.out and node.name not in found and wrong(node, place):
            found[node.name] = error(flow.graph, node, flow.way(place))
    return list(found.values())


def unmended(flow: Flow) -> list[Diagnostic]:
    """Warn if a failed trip ends its mission though nobody said so: no block retries it, no guard takes it."""
    failing = [
        node
        for node in flow.graph.nodes
        if node.block.watches and Status.FAILED in flow.leaves[node.name]
    ]
    if not failing or any(_mends(flow, node) for node in flow.graph.nodes) or _is_decided(flow):
        return []
    return [errors.failures_stop(flow.graph, failing[0])]


def _is_decided(flow: Flow) -> bool:
    """Whether a guard says where a mission goes whose trip has failed."""
    guarded = {(e.source, e.target) for e in flow.edges if Status.FAILED in (e.guard or ())}
    return any(
        before.facts.outcome is place.status is Status.FAILED
        for before, place in flow.after.edges
        if (before.node, place.node) in guarded
    )


def unbounded(flow: Flow) -> list[Diagnostic]:
    """Warn once of all loops in which a trip that always fails would be retried for ever."""
    after = nx.DiGraph()
    after.add_nodes_from(flow.places)
    steps = [(p, target) for p, target in flow.after.edges if _is_failure(flow, p, target)]
    # of ways round that are as short, the one over places that were found first is shown
    found_as = {place: number for number, place in enumerate(flow.places)}
    after.add_edges_from(sorted(steps, key=lambda step: found_as[step[1]]))
    shown: tuple[str, ...] = ()
    mending: dict[str, Node] = {}
    for part in loops(after):
        inside = set(part)
        for place in part:
            if _is_mended(place, [t for t in after[place] if t in inside]):
                shown = shown or blocks_of(round_of(after, part, place))
                mending.setdefault(place.node, flow.graph.node[place.node])
    if not mending:
        return []
    first, *others = mending.values()
    return [errors.fails_forever(flow.graph, first, shown, others[:_MOST_SHOWN])]


def _is_mended(place: Place, targets: Iterable[Place]) -> bool:
    """Whether a failed mission leaves this place in a better state."""
    return place.status is Status.FAILED and any(t.status is not Status.FAILED for t in targets)


def _mends(flow: Flow, node: Node) -> bool:
    """Whether a failed mission comes here, and may leave in a better state."""
    return Status.FAILED in flow.arrives[node.name] and bool(
        node.emitted(Status.FAILED) - {Status.FAILED}
    )


def _is_failure(flow: Flow, place: Place, target: Place) -> bool:
    """Whether a mission can take this step without limit although no flight of its trip succeeds."""
    node = flow.graph.node[place.node]
    if target.status is Status.FAILED:
        return True
    if node.block.evaluates or node.block.repeats:
        return False
    return not (node.block.watches or node.block.skips or bound_of(node))


def repeated_unjudged(flow: Flow) -> list[Diagnostic]:
    """Warn if a mission is repeated before it was evaluated."""
    graph = flow.graph
    # behind a launch it is another flight that is judged
    unlaunched = (e for e in flow.edges if flow.carries[e] and not _launches(flow, e.source))
    after = arrows_of(graph, unlaunched)
    found = []
    for node in graph.nodes:
        if node.block.repeats and flow.arrives[node.name]:
            follow = reachable(after, [node.name])
            judges = [n for n in graph.nodes if n.block.evaluates and n.name in follow]
            if judges:
                found.append(errors.repeated_unjudged(graph, node, judges[0]))
    return found


def _launches(flow: Flow, name: str) -> bool:
    node = flow.graph.node.get(name)
    return node is not None and node.block.launches
