"""Where an edge may lead that is being drawn, and why not to the other blocks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from plutoc.block import IN_GRAPH
from plutoc.graph.built_in import EVENTS
from plutoc.graph.model import END, START, Edge, Node
from plutoc.graph.stops import END_ACCEPTS
from plutoc.service.document import Document
from plutoc.syntax.tree import BlockDecl
from plutoc_runtime.domain.status import Status


def targets(document: Document, source: str, when: Sequence[str]) -> Mapping[str, str | None]:
    """Return for every block, and `end`, None where an edge may lead there, else why not."""
    graph = document.graph
    node = graph.node.get(source)
    sources = {*graph.sources, *EVENTS, *(event.name for event in graph.events)} - {*graph.node}
    names = [s.name.text for s in document.file.app.statements if isinstance(s, BlockDecl)]
    wanted = {status for status in IN_GRAPH if status.value in when}
    edges = graph.outgoing.get(source, ())
    found: dict[str, str | None] = {}
    for name in dict.fromkeys([*names, END]):
        target = graph.node.get(name)
        if source == START:
            found[name] = _from_start(name, target, edges)
        elif source in sources:
            found[name] = _from_event(source, name, target, edges)
        elif node is None:
            found[name] = f"the kind of `{source}` is not known"
        elif name != END and target is None:
            found[name] = f"the kind of `{name}` is not known"
        elif target is not None and target.block.creates:
            found[name] = f"missions begin at `{name}`: only {_source_of(target)} leads there"
        elif any(edge.target == name and _guard(edge) == wanted for edge in edges):
            found[name] = f"this edge from `{source}` to `{name}` is there already"
        else:
            found[name] = _passing(node, name, target, wanted)
    return found


def _from_event(event: str, name: str, target: Node | None, edges: Sequence[Edge]) -> str | None:
    if target is None or not target.block.creates or target.hook is None:
        return "an event leads to a block that makes missions of events, and to no other"
    if any(edge.target == name for edge in edges):
        return f"`{event}` leads to `{name}` already"
    return None


def _from_start(name: str, target: Node | None, edges: Sequence[Edge]) -> str | None:
    if target is None or not target.block.creates or target.hook is not None:
        return "start leads to the block that makes the user's missions, and to no other"
    return f"start leads to `{edges[0].target}` already" if edges else None


def _source_of(creator: Node) -> str:
    return "start" if creator.hook is None else "an event"


def _guard(edge: Edge) -> set[Status]:
    return set(edge.guard or ())


def _passing(source: Node, name: str, target: Node | None, wanted: set[Status]) -> str | None:
    """Return why no status can pass, or not all that are wanted."""
    out = source.emits
    plain = END_ACCEPTS if target is None else target.block.accepts
    by_guard = END_ACCEPTS if target is None else target.block.accepts_by_guard
    refused = wanted - by_guard
    if refused:
        return f"`{name}` does not take {_listed(refused)}, only {_listed(by_guard)}"
    if wanted - out:
        return f"`{source.name}` never gives {_listed(wanted - out)}, only {_listed(out)}"
    if not wanted and not out & plain:
        return (
            f"`{name}` takes {_listed(plain) or 'nothing without a guard'},"
            f" and `{source.name}` gives {_listed(out) or 'nothing'}"
        )
    return None


def _listed(statuses: Collection[Status]) -> str:
    return ", ".join(status.value for status in IN_GRAPH if status in statuses)
