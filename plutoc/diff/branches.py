"""Comparing forks: added and removed branches, their order, and their gates."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from plutoc.check.model import Fork
from plutoc.diff.both import Both, Side
from plutoc.diff.journeys import places
from plutoc.diff.messages import forks as messages
from plutoc.diff.model import Change, Reroute
from plutoc.diff.roles import Role, limited, role
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import Status

_Forks = dict[tuple[str, Status], Fork]


def limits(both: Both) -> Iterator[Change]:
    """Tell which times in flight are watched now, and which no more."""
    before, after = _limits(both.old), _limits(both.new)
    for what, nodes in before.items():
        if what not in after:
            yield messages.limit_of_one(what, nodes, is_new=False)
    for what, nodes in after.items():
        if what not in before:
            yield messages.limit_of_one(what, nodes, is_new=True)


def branches(both: Both, moved: Sequence[Reroute]) -> Iterator[Change]:
    """Tell what goes on beside something else now, and what no more."""
    before, after = _limits(both.old), _limits(both.new)
    for one in moved:
        was, now = Counter(both.old.called(one.before)), Counter(one.after)
        stays = [name for name in now if name in was]
        if not (one.forks and stays):
            continue
        spans = places(both.old, one.old, one.statuses), places(both.new, one.new, one.statuses)
        for name in dict.fromkeys(one.before):
            known, node = both.old.called([name])[0], both.old.graph.node.get(name)
            if known not in now and not _is_told(node, after):
                yield messages.branch_of_one(both.old.graph, one, name, stays, spans, is_new=False)
        for name in now:
            if name in was and was[name] != now[name]:
                yield messages.branch_repeated(one, name, was[name], now[name], spans)
            elif name not in was and not _is_told(both.new.graph.node.get(name), before):
                yield messages.branch_of_one(both.new.graph, one, name, stays, spans, is_new=True)


def gates(both: Both) -> Iterator[Change]:
    """Tell of forks that close by another rule: the first branch counts, or all do."""
    before = _by_origin(both.old)
    for origin, fork in _by_origin(both.new).items():
        known = before.get(origin)
        if known is None:
            continue
        old, new = both.old.graph.node[known.gate], both.new.graph.node[fork.gate]
        was, now = old.block.gate, new.block.gate
        if was and now and was is not now:
            yield messages.gate_changed(fork, old, new, was, now)


def order(both: Both) -> Iterator[Change]:
    """Tell of branches in another order: what falls on one instant happens in that order.

    How a trip ended, and that its time is over, is the same to all branches, in any order. So it
    counts only where something else is done.
    """
    before = _by_origin(both.old)
    for origin, fork in _by_origin(both.new).items():
        known = before.get(origin)
        if known is None:
            continue
        was = both.old.called(edge.target for edge in known.branches)
        now = tuple(edge.target for edge in fork.branches)
        if was != now and sorted(was) == sorted(now) and _acts(both.new, fork):
            yield messages.order_changed(known, fork, was, now)


def _limits(side: Side) -> dict[str, tuple[Node, ...]]:
    """What is watched in flight, and by which blocks."""
    found: dict[str, tuple[Node, ...]] = {}
    for node in side.graph.nodes:
        if node.block.limits and not node.block.interrupts:
            what = limited(node.block)
            found[what] = (*found.get(what, ()), node)
    return found


def _is_told(node: Node | None, elsewhere: dict[str, tuple[Node, ...]]) -> bool:
    """Return whether it is a limit that the other app knows nothing of: that is told as such."""
    if node is None or not node.block.limits:
        return False
    return node.block.interrupts or limited(node.block) not in elsewhere


def _by_origin(side: Side) -> _Forks:
    """The forks by where they begin, as the new app calls it."""
    return {(side.called([f.node])[0], f.status): f for f in side.checked.forks}


def _acts(side: Side, fork: Fork) -> bool:
    """Return whether a branch of a fork does more than to watch."""
    ahead = [(edge.target, fork.status) for edge in fork.branches]
    known: dict[tuple[str, Status], None] = {}
    while ahead:
        name, status = ahead.pop()
        node = side.graph.node.get(name)
        if node is None or name == fork.gate or (name, status) in known:
            continue
        known[name, status] = None
        if role(node) not in (Role.WATCHES, Role.LIMITS, Role.INTERRUPTS, Role.GATE):
            return True
        for left in side.checked.leaves[name]:
            ahead.extend((target, left) for target in side.routes[name, left])
    return False
