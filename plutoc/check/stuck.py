"""Statuses that no edge takes: a mission that is stuck, or one that ends without saying so."""

from __future__ import annotations

from collections.abc import Collection

from plutoc.check import errors
from plutoc.check.branches import Branch, Branches
from plutoc.check.flow import Flow, Fork, Place, is_final
from plutoc.check.forks import gates_of
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import IN_GRAPH, Status

Left = tuple[Node, tuple[Status, ...], Place]
"""A block, the statuses of it that no edge takes, and where it is left with the first of them."""


def stuck(flow: Flow, found: Branches, idle: Collection[str]) -> list[Diagnostic]:
    """Find where missions are left: one message a block, or for all that a fork leaves open.

    What comes to an `idle` gate was meant to be in a fork: what is left behind it is not said.
    """
    diagnostics = []
    walked = set(flow.edges)
    # an arrow that must not be there has its own message, and was meant to take something
    wrong = {edge.source for edge in flow.graph.edges if edge not in walked}
    open_forks: dict[Fork, list[Left]] = {}
    for node in flow.graph.nodes:
        left = _left(flow, node)
        if not left or node.name in wrong:
            continue
        statuses = tuple(s for s in IN_GRAPH if s in left)
        place = left[statuses[0]]
        if place.frame is not None:
            open_forks.setdefault(place.frame.split.fork, []).append((node, statuses, place))
        else:
            way = flow.way(place, statuses[0])
            if not any(hop.node in idle for hop in way):
                taker = _taker(flow, node, statuses[0])
                diagnostics.append(errors.stuck(flow.graph, node, statuses, way, taker))
    for fork, lost in open_forks.items():
        _, statuses, place = lost[0]
        blocks = [(node, left) for node, left, _ in lost]
        way = flow.way(place, statuses[0])
        gate = _gate(flow, found[fork])
        diagnostics.append(errors.stuck_in_fork(flow.graph, fork, blocks, gate, way))
    return diagnostics


def ends(flow: Flow) -> list[Diagnostic]:
    """Warn of blocks where missions end without an edge to `end`."""
    left: dict[str, list[Status]] = {}
    for name, status in implicit_ends(flow):
        left.setdefault(name, []).append(status)
    return [
        errors.implicit_end(
            flow.graph, flow.graph.node[name], statuses, flow.way_to(name, statuses[0])
        )
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


def _left(flow: Flow, node: Node) -> dict[Status, Place]:
    """Where missions are left at a block, by the status that no edge takes."""
    left: dict[Status, Place] = {}
    for place, status in flow.loose:
        if place.node == node.name and not is_final(status):
            left.setdefault(status, place)
    return left


def _gate(flow: Flow, branches: tuple[Branch, ...]) -> str | None:
    """The gate that a fork most likely should close at: its other branches', or one left over."""
    spare = (n.name for n in flow.graph.nodes if n.block.gate and not flow.arrives[n.name])
    return next(iter((*gates_of(branches), *spare)), None)


def _taker(flow: Flow, node: Node, status: Status) -> str | None:
    """The block that the mission most likely should go to: it takes the status, and mends most."""
    takers = [n for n in flow.graph.nodes if status in n.block.accepts and n is not node]
    likely = sorted(takers, key=lambda n: (not n.block.allocates, not n.block.watches))
    return likely[0].name if likely else None
