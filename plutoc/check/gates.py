"""Every arrival at a gate belongs to a fork that closes there."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.branches import Branches
from plutoc.check.flow import Flow, Place
from plutoc.check.forks import gates_of
from plutoc.diagnostic import Diagnostic


def idle(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find gates that missions come to outside of any fork."""
    # where branches close at different gates, what comes behind them has been said already
    torn = {
        g for branches in found.values() if len(gates_of(branches)) > 1 for g in gates_of(branches)
    }
    closing = {gate for branches in found.values() for gate in gates_of(branches)}
    alone: dict[str, Place] = {}
    for place in flow.places:
        if place.frame is None and not place.out:
            alone.setdefault(place.node, place)
    # a branch that nothing leads to has its own message, and may be the one that a gate lacks
    spare = any(not flow.arrives[node.name] for node in flow.graph.nodes)
    diagnostics = []
    for node in flow.graph.nodes:
        if spare and node.name not in closing:
            continue
        if node.block.gate is None or node.name in torn or node.name not in alone:
            continue
        wrong = errors.outside_fork if node.name in closing else errors.closes_nothing
        diagnostics.append(wrong(flow.graph, node, flow.way(alone[node.name])))
    return diagnostics
