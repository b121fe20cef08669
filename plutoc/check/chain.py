"""What is missing on a way to a flight, and where it would stand: `allocate -> launch -> watch`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from plutoc.block import Block
from plutoc.graph.model import END, Edge, Graph, Node
from plutoc.graph.names import in_snake_case
from plutoc.graph.wording import all_of
from plutoc_runtime.domain.status import Status

Part = Callable[[Block], bool]


def _allocates(block: Block) -> bool:
    return block.allocates


def _launches(block: Block) -> bool:
    return block.launches


def watched_unlaunched(graph: Graph, node: Node, statuses: Sequence[Status]) -> list[Edge]:
    """Return the arrows from a block to those that watch a flight, if all that lacks is its launch."""
    launcher = _kind(graph, _launches)
    if launcher is None or node.block.watches or node.block.gate:
        return []
    edges = [edge for edge in graph.outgoing[node.name] if _watches(graph, edge)]
    return edges if launcher.accepts.issuperset(statuses) else []


def missing(graph: Graph, *, allocated: bool, launched: bool) -> list[str]:
    """Return the kinds of the blocks that a way lacks, as a person would call them."""
    parts = _parts(allocated, launched)
    return [kind.name if (kind := _kind(graph, part)) else "block" for part in parts]


def way_through(graph: Graph, edges: Sequence[Edge], *, allocated: bool, launched: bool) -> str:
    """Say how these arrows, which leave one block, lead through the blocks that are missing."""
    declare, names = [], []
    for part in _parts(allocated, launched):
        known = next((node.name for node in graph.nodes if part(node.block)), None)
        kind = _kind(graph, part)
        if known is None and kind is not None:
            known = in_snake_case(kind.name)
            declare.append(f"{known} = {kind.name}")
        names += [known] if known else []
    first = f"declare {all_of(declare)}, then " if declare else ""
    return first + _drawn(graph, edges, names)


def _drawn(graph: Graph, edges: Sequence[Edge], names: list[str]) -> str:
    source, targets = edges[0].source, [edge.target for edge in edges]
    stops = [source, *names, targets[0] if len(targets) == 1 else f"[{', '.join(targets)}]"]
    drawn = {(edge.source, edge.target) for edge in graph.edges}
    tail = {(names[-1], target) for target in targets}
    others = [e for e in graph.incoming[targets[0]] if e not in edges and e.source != names[-1]]
    if tail <= drawn:
        stops.pop()
        while len(stops) > 2 and (stops[-2], stops[-1]) in drawn:
            stops.pop()
        old = f"{source} -> {', '.join(targets)}"
        return f"write `{' -> '.join(stops)}{_guard(edges[0])}` instead of `{old}`"
    if others or edges[0].guard_span:
        every = f"every arrow to {all_of(targets)}" if others else f"the arrow from `{source}`"
        return f"lead {every} to `{names[0]}` instead, and write `{' -> '.join(stops[1:])}`"
    return f"write `{' -> '.join(stops)}`"


def _guard(edge: Edge) -> str:
    return f" when {', '.join(s.value for s in edge.guard)}" if edge.guard else ""


def _parts(allocated: bool, launched: bool) -> list[Part]:
    return [*([] if allocated else [_allocates]), *([] if launched else [_launches])]


def _kind(graph: Graph, part: Part) -> Block | None:
    """Return the kind that does this: one in the graph, or else one that can be declared."""
    kinds = (*(node.block for node in graph.nodes), *graph.kinds)
    return next((kind for kind in kinds if part(kind)), None)


def _watches(graph: Graph, edge: Edge) -> bool:
    return edge.target != END and graph.node[edge.target].block.watches
