"""The order of judging and repeating."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.flow import Flow
from plutoc.check.statuses import arrows_of
from plutoc.diagnostic import Diagnostic
from plutoc.graph.digraph import reachable


def repeated_unjudged(flow: Flow) -> list[Diagnostic]:
    """Warn where a mission is repeated before it was judged."""
    graph = flow.graph
    # behind a launch it is another flight that is judged
    unlaunched = (e for e in flow.edges if flow.carries[e] and not _launches(flow, e.source))
    after = arrows_of(graph, unlaunched)
    found = []
    for node in graph.nodes:
        if node.block.repeats and flow.arrives[node.name]:
            follow = reachable(after, [node.name])
            judges = [n for n in graph.nodes if n.block.evaluates and n.name in follow]
            if judges:
                found.append(errors.repeated_unjudged(graph, node, judges[0]))
    return found


def _launches(flow: Flow, name: str) -> bool:
    node = flow.graph.node.get(name)
    return node is not None and node.block.launches
