"""Every arrival at a gate belongs to a fork that closes there."""

from __future__ import annotations

from plutoc.check import fork_errors as errors
from plutoc.check.branches import Branches
from plutoc.check.flow import Flow, Place
from plutoc.check.forks import gates_of
from plutoc.diagnostic import Diagnostic


def idle(flow: Flow, found: Branches, *, lacking: bool) -> dict[str, Diagnostic]:
    """Find gates that missions come to outside of any fork, by name.

    Where something else is `lacking`, a block that nothing leads to, that may be the branch which a
    gate waits for: it has a message already.
    """
    # where branches close at different gates, what comes behind them has been said already
    torn = {
        g for branches in found.values() if len(gates_of(branches)) > 1 for g in gates_of(branches)
    }
    closing = {gate for branches in found.values() for gate in gates_of(branches)}
    alone: dict[str, Place] = {}
    for place in flow.places:
        if place.frame is None and not place.out:
            alone.setdefault(place.node, place)
    idle: dict[str, Diagnostic] = {}
    for name, place in alone.items():
        node = flow.graph.node.get(name)
        if node is None or node.block.gate is None or name in torn:
            continue
        way = flow.way(place)
        # behind a gate that closes nothing comes what was meant to be in a fork
        behind_another = any(hop.node in idle for hop in way)
        if name in closing:
            idle[name] = errors.outside_fork(flow.graph, node, way)
        elif not lacking and not behind_another:
            idle[name] = errors.closes_nothing(flow.graph, node, way)
    return idle
