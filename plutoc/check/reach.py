"""The checks of reachability: the entry, unreached blocks, edges that are never taken."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence

import networkx as nx

from plutoc.check import errors
from plutoc.check.flow import Flow, Place, is_final, ordered
from plutoc.check.side_by_side import watched_before
from plutoc.diagnostic import Diagnostic
from plutoc.graph.digraph import components, reachable, subgraph
from plutoc.graph.model import END, START, Edge, Graph, Node
from plutoc_runtime.domain.status import Status


def entry(graph: Graph) -> tuple[tuple[Node, ...], tuple[Edge, ...], list[Diagnostic]]:
    """Return the blocks that create missions, the edges to explore, and the errors.

    The first one makes missions of the user's trips, the others of events.
    """
    of_events = [node for node in graph.nodes if node.block.creates and node.hook]
    creators = [node for node in graph.nodes if node.block.creates and not node.hook]
    if not creators:
        return (), (), [errors.no_creator(graph, of_events)]
    started = {edge.target for edge in graph.outgoing[START]}
    creator = next((node for node in creators if node.name in started), creators[0])
    found = [errors.second_creator(graph, n, creator) for n in creators if n is not creator]
    if creator.name not in started:
        found.append(errors.no_start(graph, creator))
    creates = {node.name: node for node in (creator, *of_events)}
    edges = []
    for edge in graph.edges:
        told = _of_sources(graph, edge, creator, creates)
        if told is None:
            edges.append(edge)
        else:
            # a second creator is wrong already, however it is reached
            found += [told] if edge.target not in {n.name for n in creators[1:]} else []
    led_to = {edge.target for edge in edges if edge.source in graph.sources}
    found += [errors.no_event(graph, node) for node in of_events if node.name not in led_to]
    reached = [node for node in of_events if node.name in led_to]
    return (creator, *reached), tuple(edges), found


def _of_sources(
    graph: Graph, edge: Edge, creator: Node, creates: Mapping[str, Node]
) -> Diagnostic | None:
    """Return what is wrong with an edge, if a source leads elsewhere than to a creator of its own.

    Or if a block leads to a creator.
    """
    target = creates.get(edge.target)
    if edge.source not in graph.sources:
        return errors.into_creator(graph, edge, target) if target else None
    if edge.source == START:
        return errors.start_elsewhere(graph, edge, creator) if target is not creator else None
    if target is None or target is creator:
        return errors.event_elsewhere(graph, edge, tuple(creates.values())[1:])
    return None


def unreached(
    flow: Flow, creators: Sequence[str], missed: Callable[[Node], bool]
) -> list[Diagnostic]:
    """Find unreachable blocks, one message for each connected group.

    A stuck mission lacks an arrow to a block that could take it: that such a block is unreached
    follows from it, and is not reported again. The same holds for blocks that other findings miss.
    """
    graph = flow.graph
    reached = reachable(flow.arrows, creators)
    # a second creator has its own message, and may be the way to others
    lost = subgraph(
        flow.arrows, (n.name for n in graph.nodes if n.name not in reached and not n.block.creates)
    )
    parts = components(lost)
    island = {name: index for index, part in enumerate(parts) for name in part}
    led_to = {target for source, target in lost.edges if island[source] != island[target]}
    left = {status for _, status in flow.loose if not is_final(status)}

    def is_told(name: str) -> bool:
        return bool(left & graph.node[name].block.accepts) or missed(graph.node[name])

    return [
        errors.unreached(graph, graph.node[part[0]], _behind(lost, part[0]))
        for part in parts
        if led_to.isdisjoint(part)
        and not _creator_leads(graph, reached, part)
        and not any(map(is_told, reachable(lost, part)))
    ]


def _behind(lost: nx.DiGraph, first: str) -> tuple[str, ...]:
    """The other blocks that this one leads to."""
    follow = nx.descendants(lost, first)
    return tuple(name for name in lost if name in follow)


def _creator_leads(graph: Graph, reached: Container[str], part: tuple[str, ...]) -> bool:
    """Whether an unreached creator, which has its own message, leads here."""
    return any(
        edge.source in graph.node
        and graph.node[edge.source].block.creates
        and edge.source not in reached
        for name in part
        for edge in graph.incoming[name]
    )


def starved(flow: Flow) -> list[Diagnostic]:
    """Find blocks that missions never reach with a status that they accept."""
    found = []
    for node in flow.graph.nodes:
        if flow.arrives[node.name]:
            continue
        edges = [e for e in flow.edges if e.target == node.name and flow.leaves.get(e.source)]
        if edges and not all(is_stuck(flow, edge.source) for edge in edges):
            leaving = {edge.source: ordered(flow.leaves[edge.source]) for edge in edges}
            first = watched_before(flow.graph, node)
            if first is not None and first.name not in flow.nearest:
                first = None
            way = flow.way_to(first.name if first else edges[0].source)
            found.append(errors.starved(flow.graph, node, edges, leaving, way, first))
    return found


def untaken(flow: Flow, stopped: Flow) -> list[Diagnostic]:
    """Find edges that no status can ever take, not even after a Stop."""
    return [
        errors.untaken(flow.graph, edge, leaving, flow.way_to(edge.source))
        for edge, leaving, taken in _left_by(flow, stopped)
        if not taken and not edge.otherwise and _blames_edge(flow, edge)
    ]


def spent(flow: Flow, stopped: Flow) -> list[Diagnostic]:
    """Find edges along which every mission comes to a block that needs a trip with none left, and ends there.

    Each status is looked at by itself: what an edge takes besides may well be flown.
    """
    ends: dict[tuple[str, str, Status], tuple[Flow, Place] | None] = {}
    for explored in (flow, stopped):
        for before, place in explored.after.edges:
            node = flow.graph.node.get(place.node)
            if node is not None and node.block.needs_trip:
                taken = before.node, place.node, place.status
                if place.facts.spent:
                    ends.setdefault(taken, (explored, before))
                else:
                    ends[taken] = None
    found = []
    for edge in flow.edges:
        for status in ordered(edge.takes):
            last = ends.get((edge.source, edge.target, status))
            if last is not None:
                explored, before = last
                way = explored.way(before, status)
                found.append(errors.nothing_to_fly(flow.graph, edge, status, way))
    return found


def spare(flow: Flow, stopped: Flow) -> list[Diagnostic]:
    """Warn of guards with impossible statuses, and of an `otherwise` with none left."""
    found = []
    for edge, leaving, taken in _left_by(flow, stopped):
        never = tuple(s for s in edge.guard or () if s not in leaving)
        if taken and never:
            found.append(errors.spare_guard(flow.graph, edge, never, leaving))
        elif not taken and edge.otherwise:
            found.append(errors.idle_otherwise(flow.graph, edge, leaving))
    return found


def _left_by(flow: Flow, stopped: Flow) -> Iterator[tuple[Edge, tuple[Status, ...], bool]]:
    """Yield each edge with the statuses that leave its block, and whether any of them takes it."""
    for edge in flow.edges:
        if edge.source in flow.graph.node and flow.leaves[edge.source]:
            leaving = ordered(flow.leaves[edge.source] | stopped.leaves[edge.source])
            yield edge, leaving, bool(flow.carries[edge] or stopped.carries[edge])


def _blames_edge(flow: Flow, edge: Edge) -> bool:
    """Whether the edge itself is wrong, and not a starved block or a stuck mission before it."""
    if is_stuck(flow, edge.source):
        return False
    return edge.target == END or bool(flow.arrives[edge.target])


def is_stuck(flow: Flow, name: str) -> bool:
    """Whether a mission can get stuck at this block with a status that is not final."""
    return any(place.node == name and not is_final(s) for place, s in flow.loose)
