"""Drones and launches: what a mission must have behind it where it comes to a block."""

from __future__ import annotations

from collections.abc import Callable

from plutoc.check import errors
from plutoc.check.flow import Flow, Place, Way
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Graph, Node


def undrawn(flow: Flow) -> list[Diagnostic]:
    """Find launches with no allocation since the launch before."""
    return _first(
        flow, lambda node, p: node.block.launches and not p.facts.allocated, errors.no_allocation
    )


def unlaunched(flow: Flow) -> list[Diagnostic]:
    """Find blocks that watch a flight on a way without a launch."""
    return _first(
        flow, lambda node, p: node.block.watches and not p.facts.launched, errors.no_launch
    )


def held(flow: Flow) -> list[Diagnostic]:
    """Warn of missions that rest with a drone allocated that nobody else can use."""
    return _first(flow, lambda node, p: node.block.holds and p.facts.allocated, errors.drone_held)


def _first(
    flow: Flow,
    wrong: Callable[[Node, Place], bool],
    error: Callable[[Graph, Node, Way], Diagnostic],
) -> list[Diagnostic]:
    """Report each block for which it is wrong, with the shortest way that shows it."""
    found: dict[str, Diagnostic] = {}
    for place in flow.places:
        node = flow.graph.node.get(place.node)
        # a clone that was flown before its gate has its own message
        if node and not place.out and node.name not in found and wrong(node, place):
            found[node.name] = error(flow.graph, node, flow.way(place))
    return list(found.values())
