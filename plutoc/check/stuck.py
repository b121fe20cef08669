"""Statuses that no edge takes: a mission that is stuck, or one that ends without saying so."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.flow import Flow, Place, is_final
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Node
from plutoc_runtime.status import IN_GRAPH, Status


def stuck(flow: Flow) -> list[Diagnostic]:
    """Find where missions are left, one message a block."""
    found = []
    walked = set(flow.edges)
    # an arrow that must not be there has its own message, and was meant to take something
    wrong = {edge.source for edge in flow.graph.edges if edge not in walked}
    for node in flow.graph.nodes:
        left = _left(flow, node)
        if left and node.name not in wrong:
            place, status = next(iter(left.values()))
            statuses = tuple(s for s in IN_GRAPH if s in left)
            way = flow.way(place, status)
            found.append(errors.stuck(flow.graph, node, statuses, way, _taker(flow, node, status)))
    return found


def ends(flow: Flow) -> list[Diagnostic]:
    """Warn of blocks where missions end without an edge to `end`."""
    left: dict[str, list[Status]] = {}
    for name, status in implicit_ends(flow):
        left.setdefault(name, []).append(status)
    return [
        errors.implicit_end(flow.graph, flow.graph.node[name], statuses)
        for name, statuses in left.items()
    ]


def implicit_ends(flow: Flow) -> tuple[tuple[str, Status], ...]:
    """Return where missions end without an edge to `end`; in a fork that is another mistake."""
    left = {
        (place.node, status)
        for place, status in flow.loose
        if place.frame is None and is_final(status)
    }
    return tuple((name, s) for name in flow.graph.node for s in IN_GRAPH if (name, s) in left)


def _left(flow: Flow, node: Node) -> dict[Status, tuple[Place, Status]]:
    left: dict[Status, tuple[Place, Status]] = {}
    for place, status in flow.loose:
        if place.node == node.name and not is_final(status):
            left.setdefault(status, (place, status))
    return left


def _taker(flow: Flow, node: Node, status: Status) -> str | None:
    """The block that the mission most likely should go to: it takes the status, and mends most."""
    takers = [n for n in flow.graph.nodes if status in n.block.accepts and n is not node]
    likely = sorted(takers, key=lambda n: (not n.block.allocates, not n.block.watches))
    return likely[0].name if likely else None
