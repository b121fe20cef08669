"""Comparing the routes of missions, and where they resume after a Stop."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from plutoc.block import IN_GRAPH
from plutoc.diff.both import Both, Side
from plutoc.diff.messages import routes as messages
from plutoc.diff.model import Change, Reroute
from plutoc.diff.roles import Role, decides, role
from plutoc.graph.model import END, Node
from plutoc.source import Span
from plutoc_runtime.domain.status import Status

_WATCH = (Role.WATCHES, Role.LIMITS, Role.INTERRUPTS)


def reroutes(both: Both) -> tuple[Reroute, ...]:
    """Return all of them, each once: a gate passes on what was decided before it."""
    every = list(_each(both))
    told = {_way(both, one) for one in every if role(one.new) is not Role.GATE}
    ended = {_way(both, one) for one in every if role(one.new) in _WATCH}
    found: dict[object, Reroute] = {}
    for one in every:
        passes_on = role(one.new) is Role.GATE and _way(both, one) in told
        # a hook that decides how a trip has ended, as those do that watch it
        beside = role(one.new) is Role.CALLS and decides(one.new) and _way(both, one) in ended
        if passes_on or beside:
            continue
        if role(one.new) in _WATCH:  # they all say how the trip ended
            key: object = _way(both, one)
        elif decides(one.new):
            key = (one.new.name, one.statuses)
        else:
            key = (one.new.name, one.before, one.after)
        if key not in found:
            found[key] = one
        elif role(one.new) not in _WATCH:
            known = found[key]
            found[key] = replace(known, statuses=(*known.statuses, *one.statuses))
    return tuple(found.values())


def journeys(both: Both, moved: Sequence[Reroute]) -> Iterator[Change]:
    """Tell what comes next for missions that went elsewhere before.

    Where a block has left one place for another, what comes behind it now needs no saying.
    """
    straight = [one for one in moved if not (one.forks and _stays(both, one))]
    steps = [_steps_between(both, one) for one in straight]
    came = {added[0] for added, _ in steps if len(added) == 1}
    went = {both.old.called(removed)[0] for _, removed in steps if len(removed) == 1}
    for one, (added, removed) in zip(straight, steps, strict=True):
        spans = places(both.old, one.old, one.statuses), places(both.new, one.new, one.statuses)
        if one.new.name in came & went:
            continue
        if added:
            yield messages.step_added(both, one, added, spans)
        elif removed:
            yield messages.step_removed(both, one, removed, spans)
        else:
            yield messages.rerouted(both, one, spans)


def gained(both: Both) -> Iterator[Change]:
    """Tell what a block can say of a mission that it never said before, or says no more."""
    for old, new in both.common():
        if not (decides(old) or decides(new)):
            continue
        for status in IN_GRAPH:
            had = (old.name, status) in both.old.destinations
            has = (new.name, status) in both.new.destinations
            if has and not had:
                leads = both.new.destinations[new.name, status]
                yield messages.outcome_added(both.new, new, status, leads)
            elif had and not has and role(new) is not Role.RETRIES:  # its bound is told
                led = both.old.destinations[old.name, status]
                yield messages.outcome_removed(old, new, status, led)


def places(side: Side, node: Node, statuses: tuple[Status, ...]) -> tuple[Span, ...]:
    """Return the arrows by which missions leave, past the gates; where there are none, the block."""
    own = {f.gate for f in side.checked.forks if f.node == node.name and f.status in statuses}
    return tuple(dict.fromkeys(_arrows(side, node, frozenset(statuses), own)))


def _arrows(
    side: Side, node: Node, statuses: frozenset[Status], passed: Collection[str]
) -> Iterator[Span]:
    carries, none = side.checked.carries, True
    for edge in side.graph.outgoing[node.name]:
        carried = carries[edge] & statuses
        if not carried:
            continue
        none, target = False, side.graph.node.get(edge.target)
        if target is None or target.block.gate is None or target.name in passed:
            yield edge.span
        else:
            yield from _arrows(side, target, carried, {*passed, target.name})
    if none:
        yield node.name_span


def _each(both: Both) -> Iterator[Reroute]:
    for old, new in both.common():
        for status in IN_GRAPH:
            before = both.old.destinations.get((old.name, status))
            after = both.new.destinations.get((new.name, status))
            if before and after and both.old.known(before) != both.new.known(after):
                yield Reroute(old=old, new=new, statuses=(status,), before=before, after=after)


def _way(both: Both, one: Reroute) -> tuple[Status, tuple[str, ...], tuple[str, ...]]:
    return one.statuses[0], both.old.known(one.before), both.new.known(one.after)


def _stays(both: Both, one: Reroute) -> bool:
    """Return whether a mission is still somewhere where it was before: then branches are told."""
    return not {*both.old.called(one.before)}.isdisjoint(one.after)


def _steps_between(both: Both, one: Reroute) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the blocks that missions pass in between now, or those that they passed before."""
    status = one.statuses[0]
    added = _steps(both.new, one.after, status, both.old.known(one.before))
    removed = _steps(both.old, one.before, status, both.new.known(one.after))
    if not (added or removed) and _retries(both.old, one.before):
        # that failed trips are not put back matters more than what comes instead
        removed = () if _flown_again(both.new, one) else one.before
    if added and removed:  # one block or two have moved, and all between them has not
        return (added, ()) if len(added) <= len(removed) else ((), removed)
    return added, removed


def _retries(side: Side, names: tuple[str, ...]) -> bool:
    """Return whether missions come to a block that puts their failed trips back, and nowhere else."""
    node = side.graph.node.get(names[0]) if len(names) == 1 else None
    return node is not None and node.block.retries


def _flown_again(side: Side, one: Reroute) -> bool:
    """Return whether failed trips are put back now, by a block of its own or by one that allocates."""
    nodes = [side.graph.node.get(name) for name in one.after]
    allocates = any(n is not None and role(n) is Role.ALLOCATES for n in nodes)
    return _retries(side, one.after) or (allocates and one.statuses == (Status.FAILED,))


def _steps(
    side: Side, names: tuple[str, ...], status: Status, goal: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the blocks that a mission passes before it comes where it came, or comes, straight.

    It passes a block that it can leave with the status that it came with.
    """
    steps: list[str] = []
    while side.known(names) != goal:
        if len(names) != 1 or names[0] == END or names[0] in steps:
            return ()
        steps.append(names[0])
        names = side.destinations.get((names[0], status), ())
    return tuple(steps)


_Swaps = dict[tuple[str, str], dict[Status, Reroute]]
"""The step that came first and the one that comes first now, by their new names: for each status
the way out of the former."""


def without_swaps(
    both: Both, moved: Sequence[Reroute]
) -> tuple[tuple[Reroute, ...], tuple[Change, ...]]:
    """Return the ways that are not explained by steps that changed places, and what explains them.

    `x -> y` has become `y -> x`, and what came behind `y` comes behind `x` now.
    """
    swaps: _Swaps = {}
    for one in moved:
        for second, status in _swapped(both, one):
            swaps.setdefault((one.new.name, second), {})[status] = one
    told = tuple(
        _told(both, next(iter(ways.values())), second, tuple(ways))
        for (_, second), ways in swaps.items()
    )
    return tuple(_left(both, moved, swaps)), told


def _told(both: Both, one: Reroute, second: str, statuses: tuple[Status, ...]) -> Change:
    now = places(both.new, both.new.graph.node[second], statuses)
    return messages.swapped(both, one, second, statuses, (places(both.old, one.old, statuses), now))


def _swapped(both: Both, one: Reroute) -> Iterator[tuple[str, Status]]:
    """Yield what has changed places with the block that this way leads out of."""
    if one.forks:
        return
    (second,), old_second = both.old.called(one.before), one.before[0]
    for status in one.statuses:
        back = both.new.destinations.get((second, status))
        behind = both.old.destinations.get((old_second, status), ())
        if back == (one.new.name,) and both.old.called(behind) == one.after:
            yield second, status


def _left(both: Both, moved: Sequence[Reroute], swaps: _Swaps) -> Iterator[Reroute]:
    for one in moved:
        before, name = both.old.called(one.before), one.new.name
        explained = {
            status
            for (first, second), ways in swaps.items()
            if name in (first, second) or (before == (first,) and one.after == (second,))
            for status in ways
        }
        statuses = tuple(status for status in one.statuses if status not in explained)
        if statuses:
            yield replace(one, statuses=statuses)


def stops(both: Both) -> Iterator[Change]:
    """Tell where it goes on now, for the blocks that both apps have: once for all of a kind."""
    found: dict[tuple[tuple[str, ...], tuple[str, ...]], list[tuple[Node, Node]]] = {}
    for old, new in both.common():
        if role(new) is Role.GATE:  # no mission waits in a gate: what stands before it is told
            continue
        before = both.old.checked.resumes[old.name]
        after = both.new.checked.resumes[new.name]
        if {*both.old.called(before)} != {*after}:
            found.setdefault((before, after), []).append((old, new))
    for (before, after), nodes in found.items():
        was = tuple(old.name_span for old, _ in nodes)
        yield messages.resumes_elsewhere([new for _, new in nodes], before, after, was)
