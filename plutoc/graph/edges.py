"""Flows → edges: brackets expanded, and the statuses that each edge takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product

from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors
from plutoc.graph.hooks import statuses
from plutoc.graph.model import END, START, Edge, Node
from plutoc.graph.names import near
from plutoc.graph.scope import BLOCK, Scope
from plutoc.source import Source
from plutoc.syntax.tree import FlowDecl, Guard, Name
from plutoc_runtime.status import Status

END_ACCEPTS = frozenset({Status.COMPLETED, Status.FAILED})


_MOST_PROPOSALS = 100
"""Near names are looked for so often: it takes long among many, and nobody reads more."""


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
    found: list[Diagnostic],
) -> tuple[Edge, ...]:
    """Resolve all edges, in the order of the source."""
    _check_stops(source, flows, scope, nodes, found)
    resolved: list[Edge] = []
    for flow in flows:
        given = flow.guard
        guard = statuses(source, given.statuses, found) if given else []
        if given and any(name.text == START for name in flow.stops[-2].names):
            found.append(errors.guarded_start(source, given.span))
        for target in flow.stops[-1].names:
            _check_guard(source, guard, target.text, nodes, found)
        taken = frozenset(status for _, status in guard)
        for arrow in _arrows(flow):
            if _is_possible(arrow, nodes):
                resolved.append(_edge(arrow, tuple(status for _, status in guard), taken, nodes))
    _check_twice(source, resolved, found)
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


def _arrows(flow: FlowDecl) -> Iterator[Arrow]:
    last = len(flow.stops) - 2
    for i, (left, right) in enumerate(pairwise(flow.stops)):
        for source, target in product(left.names, right.names):
            yield Arrow(source=source, target=target, guard=flow.guard if i == last else None)


def _is_possible(arrow: Arrow, nodes: Mapping[str, Node]) -> bool:
    """Say whether both ends are there; where they are not, that is told elsewhere."""
    source, target = arrow.source.text, arrow.target.text
    return (source == START or source in nodes) and (target == END or target in nodes)


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


def _check_stops(
    source: Source,
    flows: Sequence[FlowDecl],
    scope: Scope,
    nodes: Mapping[str, Node],
    found: list[Diagnostic],
) -> None:
    """Check that every stop is a block, or `start` at a beginning, or `end` at an end."""
    blocks = [name for name, declared in scope.items() if declared.role == BLOCK]
    told = 0
    hopeless: set[str] = set()  # told once: a block that is missing, not a slip of the pen
    for flow in flows:
        for i, stop in enumerate(flow.stops):
            for name in stop.names:
                declared = scope.get(name.text)
                if name.text == START:
                    if i > 0:
                        found.append(errors.into_start(source, name))
                elif name.text == END:
                    if i < len(flow.stops) - 1:
                        found.append(errors.out_of_end(source, name))
                elif name.text in hopeless or name.text in nodes:
                    continue  # a block that has another thing's name is told as that
                elif declared is None or declared.role != BLOCK:
                    role = declared.role if declared else None
                    meant = near(name.text, blocks) if told < _MOST_PROPOSALS else []
                    told += 1
                    found.append(errors.unknown_block(source, name, meant, role))
                    if not meant:
                        hopeless.add(name.text)


def _check_guard(
    source: Source,
    guard: Sequence[tuple[Name, Status]],
    target: str,
    nodes: Mapping[str, Node],
    found: list[Diagnostic],
) -> None:
    if target == END:
        kind, accepted = None, END_ACCEPTS
    elif target in nodes:
        kind, accepted = nodes[target].block.name, nodes[target].block.accepts_by_guard
    else:
        return
    found.extend(
        errors.refused_status(source, name, target, kind, accepted)
        for name, status in guard
        if status not in accepted
    )


def _check_twice(source: Source, resolved: Sequence[Edge], found: list[Diagnostic]) -> None:
    first: dict[tuple[str, str, frozenset[Status] | None, bool], Edge] = {}
    for edge in resolved:
        guard = frozenset(edge.guard) if edge.guard is not None else None
        before = first.setdefault((edge.source, edge.target, guard, edge.otherwise), edge)
        if before is not edge:
            names = (edge.source, edge.target)
            found.append(errors.edge_twice(source, edge.span, edge.guard_span, before.span, names))
