"""Every mission must be able to end: statuses that no edge takes, loops without an exit."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from plutoc.block import IN_GRAPH
from plutoc.check import chain, errors
from plutoc.check.branches import Branch, Branches
from plutoc.check.facts import elsewhere, is_over, puts_trips
from plutoc.check.flow import (
    Flow,
    Fork,
    Loop,
    Place,
    Split,
    Way,
    blocks_of,
    is_final,
    ordered,
)
from plutoc.check.forks import gates_of, handed_on, past_gate
from plutoc.check.statuses import arrows_of, explore, unflown
from plutoc.diagnostic import Diagnostic
from plutoc.graph.digraph import round_of
from plutoc.graph.model import END, Edge, Node
from plutoc_runtime.domain.status import Status

Left = tuple[Node, tuple[Status, ...], Place]
"""A block, the statuses of it that no edge takes, and where it is left with the first of them."""


def stuck(flow: Flow, whole: Flow, found: Branches, idle: Collection[str]) -> list[Diagnostic]:
    """Find where missions get stuck: one message per block, or per fork.

    Missions at an `idle` gate were meant to be in a fork: what is left behind it is not reported.
    In the branches of a barred fork they are, from the `whole` exploration; behind it they are not.
    """
    forks = {split.fork for split in flow.entries}
    more = [
        (place, status)
        for place, status in whole.loose
        if place not in flow.places and place.frame and place.frame.split.fork in forks
    ]
    diagnostics = []
    walked = set(flow.edges)
    # a forbidden arrow has its own message, and was meant to take something
    wrong = {edge.source for edge in flow.graph.edges if edge not in walked}
    open_forks: dict[Fork, list[Left]] = {}
    for node in flow.graph.nodes:
        left = _left([*flow.loose, *more], node)
        if not left or node.name in wrong:
            continue
        statuses = tuple(s for s in IN_GRAPH if s in left)
        place = left[statuses[0]]
        if place.frame is not None:
            open_forks.setdefault(place.frame.split.fork, []).append((node, statuses, place))
        else:
            way = flow.way(place, statuses[0])
            if not any(hop.node in idle for hop in way):
                diagnostics.append(_stuck(flow, node, statuses, place, way))
    for fork, lost in open_forks.items():
        _, statuses, place = lost[0]
        blocks = [(node, left) for node, left, _ in lost]
        way = (flow if place in flow.places else whole).way(place, statuses[0])
        gate = _gate(whole, found[fork])
        past = past_gate(whole, found, fork, gate) if gate else None
        diagnostics.append(errors.stuck_in_fork(flow.graph, fork, blocks, gate, past, way))
    return diagnostics


def _stuck(
    flow: Flow, node: Node, statuses: tuple[Status, ...], place: Place, way: Way
) -> Diagnostic:
    """Say why a mission is stuck outside of forks, as far as that can be seen."""
    graph = flow.graph
    if node.block.gate is not None and statuses[0] is Status.RUNNING:
        ends = ordered(flow.arrives[node.name] - {Status.RUNNING})
        return errors.flight_at_gate(graph, node, handed_on(graph, node.name, way), ends, way)
    if unlaunched := chain.watched_unlaunched(graph, node, statuses):
        allocated = place.facts.allocated or node.block.allocates
        return errors.left_unlaunched(graph, node, unlaunched, way, allocated=allocated)
    return errors.stuck(graph, node, statuses, way, _taker(flow, node, statuses[0]))


def implicitly(flow: Flow) -> list[Diagnostic]:
    """Warn of blocks where missions end without an edge to `end`."""
    left: dict[str, list[Status]] = {}
    for name, status in implicit_ends(flow):
        left.setdefault(name, []).append(status)
    return [
        errors.implicit_end(
            flow.graph, flow.graph.node[name], statuses, flow.way_to(name, statuses[0])
        )
        for name, statuses in left.items()
    ]


def implicit_ends(flow: Flow) -> tuple[tuple[str, Status], ...]:
    """Return where missions end without an edge to `end`; in a fork that is another mistake."""
    left = {
        (place.node, status)
        for place, status in flow.loose
        if place.frame is None and is_final(status)
    }
    return tuple((name, s) for name in flow.graph.node for s in IN_GRAPH if (name, s) in left)


def _left(loose: Iterable[tuple[Place, Status]], node: Node) -> dict[Status, Place]:
    """The places where missions get stuck at a block, by the status that no edge takes."""
    left: dict[Status, Place] = {}
    for place, status in loose:
        if place.node == node.name and not is_final(status):
            left.setdefault(status, place)
    return left


def _gate(flow: Flow, branches: tuple[Branch, ...]) -> str | None:
    """The gate that a fork most likely should close at: its other branches', or one left over."""
    spare = (n.name for n in flow.graph.nodes if n.block.gate and not flow.arrives[n.name])
    return next(iter((*gates_of(branches), *spare)), None)


def _taker(flow: Flow, node: Node, status: Status) -> str | None:
    """The block that the mission most likely should go to: it takes the status, and mends most."""
    takers = [
        n
        for n in flow.graph.nodes
        if status in n.block.accepts and n is not node and not n.block.creates
    ]
    likely = sorted(takers, key=lambda n: (not n.block.allocates, not n.block.watches))
    return likely[0].name if likely else None


def endless(flow: Flow, astray: Collection[str]) -> list[Diagnostic]:
    """Find loops that a mission can enter and never leave, or only by a hook's failure.

    Endless loops within a fork are skipped: there the error is that the fork does not close. So are
    those of finished missions through gates in `astray`, which are reported already.
    """
    never = [part for part in flow.endless if not (_is_idle(part) and _meets(part, astray))]
    blocks = {*astray, *(place.node for part in never for place in part)}
    found = [_endless(flow, part) for part in never if any(place.frame is None for place in part)]
    # a way round within a branch may lie on another one, which leads through the branch's gate
    for edges in (flow.edges, _within_branches(flow)):
        idle = _idle(flow, edges)
        if idle is not None:
            parts = [part for part in idle.endless if not _meets(part, blocks)]
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
    """Explore missions that have nothing left to fly, as long as no hook fails them.

    Only on loops without flights, and only where a hook could fail them.
    """
    turns = unflown(flow.graph, arrows_of(flow.graph, edges))
    failing = {turns[name] for name in turns if _may_fail(flow.graph.node[name])}
    blocks = {name for name, number in turns.items() if number in failing}
    if not blocks:
        return None
    beginnings = _beginnings(flow, blocks, turns)
    if len(edges) < len(flow.edges):  # what was said is known by other numbers there
        beginnings = {p._replace(facts=elsewhere(p.facts)): None for p in beginnings}
    return explore(flow.graph, edges, beginnings, idle=blocks)


def _beginnings(flow: Flow, blocks: Collection[str], turns: Mapping[str, int]) -> dict[Place, None]:
    """Return the places of a loop; a fork that stays open all the way does not matter."""
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
    """Whether it is a clone that arrives at the gate of its fork."""
    return flow.graph.node[place.node].block.gate is not None and not place.out


def _may_fail(node: Node) -> bool:
    return node.block.evaluates or (puts_trips(node) and len(node.emitted(Status.COMPLETED)) > 1)


def _is_idle(part: Loop) -> bool:
    """Whether only missions with nothing left to fly cannot leave this loop, as their blocks repeat their answers."""
    return all(map(is_over, part)) and any(place.facts.said for place in part)


def _meets(part: Loop, blocks: Collection[str]) -> bool:
    return any(place.node in blocks for place in part)


def _endless(flow: Flow, part: Loop) -> Diagnostic:
    way, names = flow.way(part[0]), blocks_of(round_of(flow.after, part, part[0]))
    head = flow.graph.node[part[0].node]
    error = errors.spins if _is_idle(part) else errors.endless
    return error(flow.graph, head, way, names)


def _spins(flow: Flow, idle: Flow, part: Loop) -> Diagnostic:
    first = part[0]
    where = (place for place in flow.places if place._replace(frame=first.frame) == first)
    way = flow.way(next(where, flow.nearest[first.node]))
    names = blocks_of(round_of(idle.after, part, first))
    return errors.spins(flow.graph, flow.graph.node[first.node], way, names)
