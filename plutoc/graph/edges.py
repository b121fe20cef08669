"""Flows → edges: brackets expanded, and the statuses that each edge takes."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product

from plutoc.block import IN_GRAPH
from plutoc.diagnostic import Diagnostic
from plutoc.graph import edge_errors as errors
from plutoc.graph.hooks import statuses
from plutoc.graph.model import END, START, Edge, Node
from plutoc.graph.scope import BLOCK, Declared, Scope
from plutoc.graph.stops import END_ACCEPTS, accepts_by_guard, check_stops
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.source import Source
from plutoc.syntax.tree import FlowDecl, Guard, Name
from plutoc_runtime.domain.status import Status

MOST_EDGES = 100_000
"""Of an app: brackets of a thousand names each make a million of them, which is a mistake."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """One pair of a flow; a guard belongs to the last arrow of its statement."""

    source: Name
    target: Name
    guard: Guard | None


def edges(
    source: Source,
    flows: Sequence[FlowDecl],
    scope: Scope,
    nodes: Mapping[str, Node],
    events: Collection[str],
    unclear: UncertainNames,
    found: list[Diagnostic],
) -> tuple[Edge, ...]:
    """Resolve all edges, in the order of the source."""
    sources = {START, *(event for event in events if not _hides(scope.get(event)))}
    check_stops(source, flows, scope, nodes, sources, unclear, found)
    resolved: list[Edge] = []
    of_flow: list[FlowDecl] = []
    left = MOST_EDGES
    for flow in flows:
        left -= sum(len(one.names) * len(other.names) for one, other in pairwise(flow.stops))
        if left < 0:
            found.append(errors.too_many_edges(source, flow.span, MOST_EDGES))
            break
        given = flow.guard
        targets = flow.stops[-1].names
        accepted = frozenset(IN_GRAPH).intersection(
            *(accepts_by_guard(target.text, nodes) for target in targets)
        )
        guard = statuses(source, given.statuses, found, accepted) if given else []
        guarded = next((n.text for n in flow.stops[-2].names if n.text in sources), None)
        if given and guarded:
            found.append(errors.guarded_start(source, given.span, guarded))
        _check_guard(source, guard, targets, nodes, found)
        taken = frozenset(status for _, status in guard)
        for arrow in _arrows(flow):
            if _is_possible(arrow, nodes, sources):
                of_flow.append(flow)
                resolved.append(_edge(arrow, tuple(status for _, status in guard), taken, nodes))
    _check_twice(source, resolved, of_flow, found)
    taken_from: dict[str, set[Status]] = {}
    for edge in resolved:
        if not edge.otherwise:
            taken_from.setdefault(edge.source, set()).update(edge.takes)
    # `otherwise`: what the target accepts, less what the block's other edges take
    return tuple(
        (
            replace(edge, takes=edge.takes.difference(taken_from.get(edge.source, ())))
            if edge.otherwise
            else edge
        )
        for edge in resolved
    )


def _hides(declared: Declared | None) -> bool:
    """Return whether a block has the name of a built-in event, as it may."""
    return declared is not None and declared.role == BLOCK


def _arrows(flow: FlowDecl) -> Iterator[Arrow]:
    last = len(flow.stops) - 2
    for i, (left, right) in enumerate(pairwise(flow.stops)):
        for source, target in product(left.names, right.names):
            yield Arrow(source=source, target=target, guard=flow.guard if i == last else None)


def _is_possible(arrow: Arrow, nodes: Mapping[str, Node], sources: Collection[str]) -> bool:
    """Return whether both ends are there; where they are not, that is told elsewhere."""
    source, target = arrow.source.text, arrow.target.text
    return (source in sources or source in nodes) and (target == END or target in nodes)


def _edge(
    arrow: Arrow, guard: tuple[Status, ...], taken: frozenset[Status], nodes: Mapping[str, Node]
) -> Edge:
    target = arrow.target.text
    written = arrow.guard
    otherwise = written.otherwise if written else target == END
    when = written is not None and not otherwise
    return Edge(
        source=arrow.source.text,
        target=target,
        takes=taken if when else _accepts(target, nodes),
        guard=guard if when else None,
        otherwise=otherwise,
        span=arrow.source.span.to(arrow.target.span),
        guard_span=written.span if written else None,
    )


def _accepts(target: str, nodes: Mapping[str, Node]) -> frozenset[Status]:
    return END_ACCEPTS if target == END else nodes[target].block.accepts


def _check_guard(
    source: Source,
    guard: Sequence[tuple[Name, Status]],
    targets: Sequence[Name],
    nodes: Mapping[str, Node],
    found: list[Diagnostic],
) -> None:
    """Find statuses that a target refuses; of several targets, the first that does is told."""
    for name, status in guard:
        for target in targets:
            if status not in accepts_by_guard(target.text, nodes):
                kind = nodes[target.text].block.name if target.text in nodes else None
                accepted = accepts_by_guard(target.text, nodes)
                found.append(errors.refused_status(source, name, target.text, kind, accepted))
                break


def _check_twice(
    source: Source, resolved: Sequence[Edge], of_flow: Sequence[FlowDecl], found: list[Diagnostic]
) -> None:
    """Find edges that are there twice; of a statement that repeats many, the first."""
    first: dict[tuple[str, str, frozenset[Status] | None, bool], Edge] = {}
    told: FlowDecl | None = None
    for edge, flow in zip(resolved, of_flow, strict=True):
        guard = frozenset(edge.guard) if edge.guard is not None else None
        before = first.setdefault((edge.source, edge.target, guard, edge.otherwise), edge)
        if before is not edge and flow is not told:
            told = flow
            names = (edge.source, edge.target)
            found.append(errors.edge_twice(source, edge.span, edge.guard_span, before.span, names))
