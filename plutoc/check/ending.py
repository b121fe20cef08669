"""From everywhere a way must lead to an end: loops that nothing leaves, now or one day."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from plutoc.check import errors
from plutoc.check.components import round_of
from plutoc.check.facts import elsewhere, is_over, puts_trips
from plutoc.check.flow import Flow, Place, Split, blocks_of
from plutoc.check.rounds import Round, rounds
from plutoc.check.statuses import explore
from plutoc.check.unflown import unflown
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import END, Edge, Node
from plutoc_runtime.domain.status import Status


def endless(flow: Flow, astray: Collection[str]) -> list[Diagnostic]:
    """Find loops that a mission can enter and never leave, or only if a hook fails it.

    Those within a fork that nothing leaves are left out: there it is the fork that does not close. So
    are those of finished missions through gates to which they go `astray`: that has been said.
    """
    never = [part for part in rounds(flow) if not (_is_idle(part) and _meets(part, astray))]
    blocks = {*astray, *(place.node for part in never for place in part)}
    found = [_endless(flow, part) for part in never if any(place.frame is None for place in part)]
    # a way round within a branch may lie on another one, which leads through the branch's gate
    for edges in (flow.edges, _within_branches(flow)):
        idle = _idle(flow, edges)
        if idle is not None:
            parts = [part for part in rounds(idle) if not _meets(part, blocks)]
            found += [_spins(flow, idle, part) for part in parts]
            blocks.update(place.node for part in parts for place in part)
    return found


def _within_branches(flow: Flow) -> tuple[Edge, ...]:
    """Return the edges that lead to no gate."""
    return tuple(
        edge
        for edge in flow.edges
        if edge.target == END or flow.graph.node[edge.target].block.gate is None
    )


def _idle(flow: Flow, edges: tuple[Edge, ...]) -> Flow | None:
    """Follow missions that have nothing left to fly, as long as no hook fails them.

    Only on ways round where nothing is flown, and only where a hook could fail them.
    """
    turns = unflown(flow.graph, edges)
    failing = {turns[name] for name in turns if _may_fail(flow.graph.node[name])}
    blocks = {name for name, number in turns.items() if number in failing}
    if not blocks:
        return None
    beginnings = _beginnings(flow, blocks, turns)
    if len(edges) < len(flow.edges):  # what was said is known by other numbers there
        beginnings = {p._replace(facts=elsewhere(p.facts)): None for p in beginnings}
    return explore(flow.graph, edges, beginnings, idle=blocks)


def _beginnings(flow: Flow, blocks: Collection[str], turns: Mapping[str, int]) -> dict[Place, None]:
    """Return where missions are on a way round; a fork that is open all the way does not matter."""
    not_open: dict[Split, set[int]] = {}
    for place in flow.places:
        if place.frame is not None:
            split = place.frame.split
            ends = not_open.setdefault(split, {turns.get(split.node, 0)})
            if place.node in blocks and _arrives(flow, place):
                ends.add(turns[place.node])
    return {
        place._replace(frame=None): None
        for place in flow.places
        if place.node in blocks
        and is_over(place)
        and (place.frame is None or turns[place.node] not in not_open[place.frame.split])
    }


def _arrives(flow: Flow, place: Place) -> bool:
    """Is it a clone that comes to the gate of its fork?"""
    return flow.graph.node[place.node].block.gate is not None and not place.out


def _may_fail(node: Node) -> bool:
    return node.block.evaluates or (puts_trips(node) and len(node.emitted(Status.COMPLETED)) > 1)


def _is_idle(part: Round) -> bool:
    """Is it a loop that only missions with nothing left to fly cannot leave, for all is said already?"""
    return all(map(is_over, part)) and any(place.facts.said for place in part)


def _meets(part: Round, blocks: Collection[str]) -> bool:
    return any(place.node in blocks for place in part)


def _endless(flow: Flow, part: Round) -> Diagnostic:
    way, names = flow.way(part[0]), blocks_of(round_of(flow.after, part, part[0]))
    head = flow.graph.node[part[0].node]
    error = errors.spins if _is_idle(part) else errors.endless
    return error(flow.graph, head, way, names)


def _spins(flow: Flow, idle: Flow, part: Round) -> Diagnostic:
    first = part[0]
    where = (place for place in flow.places if place._replace(frame=first.frame) == first)
    way = flow.way(next(where, flow.nearest[first.node]))
    names = blocks_of(round_of(idle.after, part, first))
    return errors.spins(flow.graph, flow.graph.node[first.node], way, names)
