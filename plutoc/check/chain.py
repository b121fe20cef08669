"""What is missing on a way to a flight, and where it would stand: `allocate -> launch -> watch`."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from plutoc.block import Block
from plutoc.check.flow import Way
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


def way_through(
    graph: Graph, edges: Sequence[Edge], way: Way, *, allocated: bool, launched: bool
) -> str:
    """Say how these arrows, which leave one block, lead through the blocks that are missing."""
    declare: list[str] = []
    names: list[str] = []
    targets = [edge.target for edge in edges]
    for part in reversed(_parts(allocated, launched)):
        known = _known(graph, part, names[:1] or targets, way)
        kind = _kind(graph, part)
        if known is None and kind is not None:
            known = free_name(graph, kind)
            declare.insert(0, f"{known} = {kind.name}")
        names[:0] = [known] if known else []
    first = f"declare {all_of(declare)}, then " if declare else ""
    return first + _drawn(graph, edges, names)


def _known(graph: Graph, part: Part, targets: Sequence[str], way: Way) -> str | None:
    """Return the block that leads there, of several the last on the way; else one that leads nowhere."""
    last = {hop.node: i for i, hop in enumerate(way)}
    parts = [node.name for node in graph.nodes if part(node.block)]
    there = [name for name in parts if all(_leads(graph, name, target) for target in targets)]
    unused = [name for name in parts if not graph.outgoing[name]]
    return next(iter([*sorted(there, key=lambda name: -last.get(name, -1)), *unused]), None)


def _leads(graph: Graph, name: str, target: str) -> bool:
    """Return whether a block leads to another, through blocks at most that have nothing to do with flights."""
    seen = {name}
    waiting = [name]
    while waiting:
        for edge in graph.outgoing.get(waiting.pop(), ()):
            if edge.target == target:
                return True
            if edge.target not in seen and edge.target != END:
                seen.add(edge.target)
                block = graph.node[edge.target].block
                if not (block.allocates or block.launches or block.watches or block.gate):
                    waiting.append(edge.target)
    return False


def free_name(graph: Graph, kind: Block) -> str:
    """Return a name for another block of a kind."""
    name = in_snake_case(kind.name)
    taken = [other for other in graph.node if other == name or other.startswith(f"{name}_")]
    return f"{name}_{len(taken) + 1}" if taken else name


def _drawn(graph: Graph, edges: Sequence[Edge], names: list[str]) -> str:
    source, targets = edges[0].source, [edge.target for edge in edges]
    stops = [source, *names, targets[0] if len(targets) == 1 else f"[{', '.join(targets)}]"]
    old = f"{source} -> {stops[-1]}"
    others = [e for e in graph.incoming[targets[0]] if e not in edges and e.source != names[-1]]
    if all(_leads(graph, names[-1], target) for target in targets):
        stops.pop()
        while len(stops) > 2 and _leads(graph, stops[-2], stops[-1]):
            stops.pop()
        return f"write `{' -> '.join(stops)}{_guard(edges[0])}` instead of `{old}`"
    if others or edges[0].guard_span:
        every = f"every arrow to {all_of(targets)}" if others else f"the arrow from `{source}`"
        return f"lead {every} to `{names[0]}` instead, and write `{' -> '.join(stops[1:])}`"
    return f"write `{' -> '.join(stops)}` instead of `{old}`"


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
