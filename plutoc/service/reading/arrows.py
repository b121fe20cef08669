"""The arrows of an app: which statuses pass along each, and why others do not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from plutoc.block import IN_GRAPH
from plutoc.graph.model import Edge
from plutoc.graph.stops import accepts_by_guard
from plutoc.service.document import Document
from plutoc.source import Span
from plutoc.syntax.tree import FlowDecl
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """One `->` as it is written: with brackets beside it, it stands for several edges."""

    span: Span
    """What lies between its two stops: the sign itself, and blanks."""
    end: int
    """Where the stop ends that it leads to."""
    edges: tuple[Edge, ...]


def arrows(document: Document) -> tuple[Arrow, ...]:
    """Return all arrows whose two ends are known."""
    edges: dict[Span, list[Edge]] = {}
    for edge in document.graph.edges:
        edges.setdefault(edge.span, []).append(edge)
    found = []
    for flow in document.file.app.statements:
        if isinstance(flow, FlowDecl):
            for left, right in pairwise(flow.stops):
                pairs = [one.span.to(other.span) for one in left.names for other in right.names]
                between = tuple(edge for pair in pairs for edge in edges.get(pair, ()))
                if between:
                    span = Span(left.span.end, right.span.start)
                    found.append(Arrow(span=span, end=right.span.end, edges=between))
    return tuple(found)


def carried(document: Document, arrow: Arrow) -> tuple[Status, ...]:
    """Return the statuses that pass along an arrow, in declared order."""
    passing = frozenset().union(*(document.carries.get(edge, ()) for edge in arrow.edges))
    return tuple(status for status in IN_GRAPH if status in passing)


def why_not(document: Document, edge: Edge) -> Iterator[tuple[Status, str]]:
    """Give each status that could be expected on an edge and does not pass, with the reason."""
    passing = document.carries.get(edge, frozenset())
    leaves, accepts = emitted(document, edge.source), accepted(document, edge.target)
    for status in IN_GRAPH:
        if status not in passing and status in leaves | accepts | edge.takes:
            yield status, _reason(document, edge, status)


def _reason(document: Document, edge: Edge, status: Status) -> str:
    source, target, name = edge.source, edge.target, status.value
    if status not in emitted(document, source):
        return f"`{source}` never emits it"
    if status not in accepted(document, target):
        return f"`{target}` does not accept it"
    if status not in edge.takes:
        if edge.guard is not None:
            return "the guard does not name it"
        others = [
            one.target
            for one in document.graph.outgoing[source]
            if one is not edge and not one.otherwise and status in one.takes
        ]
        if edge.otherwise and others:
            return f"the arrow to `{others[0]}` takes it"
        return f"`{target}` accepts it only where a guard says so: `when {name}`"
    return f"no mission leaves `{source}` with it"


def emitted(document: Document, name: str) -> frozenset[Status]:
    """Return the statuses that a block can emit at all."""
    if name not in document.graph.node:
        return frozenset({Status.UNEXECUTED})
    return document.graph.node[name].emits


def accepted(document: Document, name: str) -> frozenset[Status]:
    """Return the statuses that a block accepts, with or without a guard."""
    return accepts_by_guard(name, document.graph.node)


def arriving(document: Document, name: str) -> frozenset[Status]:
    """Return the statuses with which missions reach a block."""
    edges = document.graph.incoming.get(name, ())
    return frozenset().union(*(document.carries.get(edge, frozenset()) for edge in edges))


def leaving(document: Document, name: str) -> frozenset[Status]:
    """Return the statuses with which missions leave a block."""
    node = document.graph.node[name]
    return frozenset().union(*(node.emitted(status) for status in arriving(document, name)))
