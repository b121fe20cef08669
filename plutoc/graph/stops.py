"""The stops of a flow: blocks, `start` and `end`, each where it may stand."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from plutoc.block import IN_GRAPH
from plutoc.diagnostic import Diagnostic
from plutoc.graph import edge_errors as errors
from plutoc.graph.hooks import RETURNS
from plutoc.graph.model import END, START, Node
from plutoc.graph.names import near
from plutoc.graph.scope import BLOCK, Scope
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.source import Source
from plutoc.syntax.tree import FlowDecl
from plutoc_runtime.domain.status import Status

_MOST_PROPOSALS = 100
"""Near names are looked for so often: it takes long among many, and more is not read."""


END_ACCEPTS = frozenset({Status.COMPLETED, Status.FAILED})


def accepts_by_guard(target: str, nodes: Mapping[str, Node]) -> frozenset[Status]:
    """Return what may stand in a guard to a target; of what is unknown, everything."""
    if target == END:
        return END_ACCEPTS
    return nodes[target].block.accepts_by_guard if target in nodes else frozenset(IN_GRAPH)


def meant_to_declare(
    source: Source,
    flows: Sequence[FlowDecl],
    scope: Scope,
    kinds: Collection[str],
    found: list[Diagnostic],
) -> dict[str, FlowDecl]:
    """Find flows like `wait -> Clock`, which mean `wait = Clock`; return them by that name.

    And those like `weigh -> mass`, which lack the word `action`.
    """
    declaring: dict[str, FlowDecl] = {}
    for flow in flows:
        names = [name for stop in flow.stops for name in stop.names]
        if len(names) == 2 and flow.guard is None:
            name, kind = names
            free = name.text != START and name.text not in scope
            if free and kind.text in kinds and kind.text not in scope:
                found.append(errors.kind_in_a_flow(source, name, kind))
                declaring[name.text] = flow
            elif free and kind.text in RETURNS and kind.text not in scope:
                found.append(errors.type_in_a_flow(source, name, kind))
                declaring[name.text] = flow
    return declaring


def check_stops(
    source: Source,
    flows: Sequence[FlowDecl],
    scope: Scope,
    nodes: Mapping[str, Node],
    sources: Collection[str],
    unclear: UncertainNames,
    found: list[Diagnostic],
) -> None:
    """Check that every stop is a block, or a source at a beginning, or `end` at an end."""
    blocks = [name for name, declared in scope.items() if declared.role == BLOCK]
    proposals: dict[str, list[str]] = {}
    kin: dict[str, list[str]] = {}
    inside = {
        name.text
        for flow in flows
        for i, stop in enumerate(flow.stops)
        for name in stop.names
        if not _may_be_source(flow, i)
    }
    for flow in flows:
        last = len(flow.stops) - 1
        for i, stop in enumerate(flow.stops):
            for name in stop.names:
                declared = scope.get(name.text)
                if name.text in sources:
                    if i > 0 and not unclear.may_declare(name.text):
                        found.append(errors.into_start(source, name))
                elif name.text == END:
                    if i < last:
                        found.append(errors.out_of_end(source, name))
                elif name.text in nodes or (declared and declared.role == BLOCK):
                    continue  # a block that has another thing's name is told as that
                elif not unclear.may_declare(name.text):
                    if name.text not in proposals:
                        enough = len(proposals) >= _MOST_PROPOSALS
                        legal = () if enough else _legal(flow, i, blocks, sources, nodes)
                        proposals[name.text] = near(name.text, legal)
                        kin[name.text] = [] if enough else _of_kind(name.text, nodes)
                    role = declared.role if declared else None
                    proposed = proposals[name.text]
                    creator = _creator_behind(flow, i, nodes)
                    if role or kin[name.text] or name.text in inside:
                        wrong = errors.unknown_block(source, name, proposed, role, kin[name.text])
                    elif creator is not None and creator.hook is not None:
                        wrong = errors.unknown_event(source, name, proposed, creator.hook)
                    else:
                        wrong = errors.unknown_source(source, name, proposed)
                    found.append(wrong)


def _may_be_source(flow: FlowDecl, i: int) -> bool:
    """Return whether an event may stand at a stop: at the first one, unless its arrow has a guard."""
    return i == 0 and not (flow.guard and len(flow.stops) == 2)


def _creator_behind(flow: FlowDecl, i: int, nodes: Mapping[str, Node]) -> Node | None:
    """Return what makes missions of events, if a stop leads there: nothing but an event can."""
    if not _may_be_source(flow, i):
        return None
    behind = [nodes.get(name.text) for name in flow.stops[1].names]
    return next((node for node in behind if node and node.block.creates and node.hook), None)


def _of_kind(kind: str, nodes: Mapping[str, Node]) -> list[str]:
    """Return the first blocks that are of a kind."""
    return [node.name for node in nodes.values() if node.block.name == kind][:3]


def _legal(
    flow: FlowDecl,
    i: int,
    blocks: Sequence[str],
    sources: Collection[str],
    nodes: Mapping[str, Node],
) -> Sequence[str]:
    """Return what could stand at a stop: what is proposed must not be refused there."""
    last, guard = len(flow.stops) - 1, flow.guard
    if _creator_behind(flow, i, nodes):
        return sorted(set(sources) - {START})
    if i < last:
        return [*blocks, *sorted(sources)] if _may_be_source(flow, i) else blocks
    wanted = {name.text for name in guard.statuses} if guard else set()
    return [
        name
        for name in (*blocks, END)
        if wanted.isdisjoint({s.value for s in IN_GRAPH if s not in accepts_by_guard(name, nodes)})
    ]
