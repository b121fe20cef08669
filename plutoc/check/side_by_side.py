"""How blocks that look after one flight are drawn: `launch -> [watch, timer] -> first`."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.block import Gate
from plutoc.check.chain import free_name
from plutoc.check.flow import Way
from plutoc.graph.model import END, Edge, Graph, Node
from plutoc.graph.wording import all_of
from plutoc_runtime.domain.status import Status


def behind(graph: Graph, node: Node) -> Node | None:
    """Return the block behind one that watches a flight which watches the same flight, and never gets it."""
    if not node.block.watches:
        return None
    following = (graph.node[e.target] for e in graph.outgoing[node.name] if e.target != END)
    return next((other for other in following if _takes_flight_of(other, node)), None)


def watched_before(graph: Graph, node: Node) -> Node | None:
    """Return the block before one that watches a flight which watches that flight already."""
    leading = (graph.node.get(edge.source) for edge in graph.incoming[node.name])
    watching = (other for other in leading if other is not None and other.block.watches)
    return next((other for other in watching if _takes_flight_of(node, other)), None)


def _takes_flight_of(node: Node, other: Node) -> bool:
    flies = frozenset({Status.RUNNING})
    return node is not other and node.block.watches and node.block.accepts == flies


def put_beside(graph: Graph, first: Node, second: Node, way: Way) -> str:
    """Say how two blocks, one behind the other, stand side by side; `way` leads to the first."""
    hops = [hop.node for hop in way]
    launch = hops[hops.index(first.name) - 1]
    beside = [e.target for e in graph.outgoing[launch] if Status.RUNNING in e.takes]
    beside = [name for name in beside if name != second.name] + [second.name]
    gate, declare = _gate(graph, [*reversed(beside)])
    old = [launch, first.name, second.name]
    if any(edge.target == gate for edge in graph.outgoing[second.name]):
        old.append(gate)
    written = f"`{launch} -> [{', '.join(beside)}] -> {gate}` instead of `{' -> '.join(old)}`"
    others = [
        name
        for name in (first.name, second.name)
        if any(edge.target not in (second.name, gate) for edge in graph.outgoing[name])
    ]
    rest = f", and lead the other arrows of {all_of(others)} from `{gate}`" if others else ""
    return f"put `{second.name}` beside `{first.name}`: {declare}write {written}{rest}"


def _gate(graph: Graph, names: Sequence[str]) -> tuple[str, str]:
    """Return the gate at which branches meet, and the words that declare it where there is none."""
    gates = [node.name for node in graph.nodes if node.block.gate]
    met = (e.target for name in names for e in graph.outgoing[name] if e.target in gates)
    unused = (name for name in gates if not graph.incoming[name])
    gate = next(met, None) or next(unused, None)
    if gate is not None:
        return gate, ""
    kinds = (*(node.block for node in graph.nodes), *graph.kinds)
    kind = next(kind for kind in kinds if kind.gate is Gate.FIRST)
    gate = free_name(graph, kind)
    return gate, f"declare `{gate} = {kind.name}`, "


def through_gate(graph: Graph, arrow: Edge, leaving: Status, gate: str) -> str:
    """Say how an arrow that leads past the gate of its fork leads there, and on."""
    drawn = f"{arrow.source} -> {arrow.target}"
    there = [edge for edge in graph.outgoing[arrow.source] if edge.target == gate]
    guard = arrow.guard or ((leaving,) if there else ())
    when = f" when {', '.join(status.value for status in guard)}" if guard else ""
    mend = f"write `{arrow.source} -> {gate}{when}` instead"
    if any(leaving in edge.takes for edge in there):
        mend = "remove it"
    onward = f"{gate} -> {arrow.target}"
    if not any(leaving in edge.takes for edge in graph.outgoing[gate]):
        mend += f", and add `{onward} when {leaving.value}`"
    return f"`{drawn}` leads past `{gate}`: {mend}"


def last_arrow(graph: Graph, way: Way) -> tuple[Edge, Status] | None:
    """Return the last arrow of a way, and the status that takes it."""
    if len(way) < 2 or (leaving := way[-2].leaving) is None:
        return None
    arrows = graph.outgoing[way[-2].node]
    taken = (e for e in arrows if e.target == way[-1].node and leaving in e.takes)
    arrow = next(taken, None)
    return (arrow, leaving) if arrow else None
