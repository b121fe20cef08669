"""The checks of concurrent branches: attributes written twice, limits that nothing watches."""

from __future__ import annotations

from itertools import combinations

import networkx as nx

from plutoc.check import fork_errors as errors
from plutoc.check.branches import Branch, Branches, nesting, within
from plutoc.check.flow import Flow, Fork, Frame, Way
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Node


def written_twice(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find attributes that the hooks of two branches of one fork write."""
    inside = nesting(found)
    diagnostics: dict[tuple[str, str, str], Diagnostic] = {}
    for branches in found.values():
        writers = [
            [n for n in _nodes(flow, found, inside, branch) if n.hook and n.hook.writes]
            for branch in branches
        ]
        # only the few branches that write anything are compared
        for one, other in combinations(filter(None, writers), 2):
            for first in one:
                for second in other:
                    for attribute in _common(first, second):
                        key = (first.name, second.name, attribute)
                        diagnostics.setdefault(
                            key,
                            errors.written_twice(
                                flow.graph, first, second, attribute, _ways(flow, first, second)
                            ),
                        )
    return list(diagnostics.values())


def unwatched_limits(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find blocks that limit a flight without a concurrent block that watches it."""
    inside = nesting(found)
    diagnostics: dict[str, Diagnostic] = {}
    for place in flow.places:
        node = flow.graph.node.get(place.node)
        if node is None or not node.block.limits or node.name in diagnostics:
            continue
        if not _watched(flow, found, inside, place.frame, set()):
            diagnostics[node.name] = errors.unwatched_limit(flow.graph, node, flow.way(place))
    return list(diagnostics.values())


def interrupted_twice(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find two blocks that wait for one event in one fork: one a fork and event is enough."""
    inside = nesting(found)
    diagnostics: dict[tuple[str, str], Diagnostic] = {}
    for branches in found.values():
        waiting: dict[str, Node] = {}
        nodes = {n.name: n for branch in branches for n in _nodes(flow, found, inside, branch)}
        waits = [n for n in nodes.values() if n.block.interrupts and n.name in flow.nearest]
        for node in sorted(waits, key=lambda one: one.span.start):
            if node.event is not None:
                first = waiting.setdefault(node.event, node)
                if first is not node:
                    wrong = errors.interrupted_twice(
                        flow.graph, first, node, flow.way_to(node.name)
                    )
                    diagnostics.setdefault((first.name, node.name), wrong)
    return list(diagnostics.values())


def _common(first: Node, second: Node) -> list[str]:
    others = second.hook.writes if second.hook else ()
    return [name for name in (first.hook.writes if first.hook else ()) if name in others]


def _ways(flow: Flow, first: Node, second: Node) -> list[Way]:
    return [flow.way_to(name) for name in dict.fromkeys((first.name, second.name))]


def _nodes(flow: Flow, found: Branches, inside: nx.DiGraph, branch: Branch) -> list[Node]:
    names = {name for inner in within(found, inside, branch) for name in inner.nodes}
    return sorted((flow.graph.node[name] for name in names), key=lambda node: node.span.start)


def _watched(
    flow: Flow, found: Branches, inside: nx.DiGraph, frame: Frame | None, seen: set[Fork]
) -> bool:
    """Whether a branch beside this one, or beside an outer one, only watches."""
    if frame is None or frame.split.fork in seen:
        return False
    for branch in found[frame.split.fork]:
        if branch.number != frame.branch and any(
            node.block.watches and not node.block.limits
            for node in _nodes(flow, found, inside, branch)
        ):
            return True
    around = seen | {frame.split.fork}
    return all(_watched(flow, found, inside, p.frame, around) for p in flow.entries[frame.split])
