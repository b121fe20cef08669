"""Every arrival at a gate belongs to a fork that closes there."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.branches import Branches
from plutoc.check.flow import Flow
from plutoc.check.forks import gates_of
from plutoc.diagnostic import Diagnostic


def idle(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find gates that missions come to outside of any fork."""
    # where branches close at different gates, what comes behind them has been said already
    torn = {
        g for branches in found.values() if len(gates_of(branches)) > 1 for g in gates_of(branches)
    }
    closing = {gate for branches in found.values() for gate in gates_of(branches)}
    diagnostics = []
    for node in flow.graph.nodes:
        if node.block.gate is None or node.name in torn:
            continue
        alone = [p for p in flow.places if p.node == node.name and p.frame is None and not p.out]
        if alone and node.name in closing:
            diagnostics.append(errors.outside_fork(flow.graph, node, flow.way(alone[0])))
        elif alone:
            diagnostics.append(errors.closes_nothing(flow.graph, node, flow.way(alone[0])))
    return diagnostics
