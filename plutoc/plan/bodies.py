"""Queries on bodies of steps, and the order in which the arms of a switch read best."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from plutoc.graph.model import Node
from plutoc.plan.model import (
    Arm,
    Arrived,
    Body,
    Branch,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Step,
    Switch,
    Watch,
)

Jump = Continue | Break | End | Goto


def falls(body: Body) -> bool:
    """Whether control can fall off the end of the body."""
    return all(_passes(step) for step in body)


def breaks(body: Body) -> bool:
    """Whether a `Break` in the body leaves the loop around it."""
    return _jumps(body, Break)


def continues(body: Body) -> bool:
    """Whether a `Continue` in the body restarts the loop around it."""
    return _jumps(body, Continue)


def _jumps(body: Body, jump: type[Break | Continue]) -> bool:
    return any(
        isinstance(step, jump)
        or (isinstance(step, Switch) and any(_jumps(arm.body, jump) for arm in step.arms))
        for step in body
    )


def _passes(step: Step) -> bool:
    match step:
        case Call() | Join() | Watch() | Arrived():
            return True
        case Switch():
            return any(falls(arm.body) for arm in step.arms)
        case Loop():
            return breaks(step.body)
        case Continue() | Break() | End() | Goto() | Dispatch():
            return False


def switch(arms: Iterable[Arm]) -> Body:
    """Return a switch with its arms in the best order; a single arm that falls through is moved behind it.

    Arms that leave at once come first, then arms that leave later, then those that go on: so the
    main line stays flat, and the exceptions to it stand indented above.
    """
    ordered = sorted(arms, key=_rank)
    # an interrupted mission's place is always one of those asked for
    decided = any(arm.places for arm in ordered)
    if all(_rank(arm) == 0 for arm in ordered):
        ordered.sort(key=lambda arm: arm.body == (Continue(),))
    *early, last = ordered
    if any(falls(arm.body) for arm in early):
        return (Switch(arms=tuple(ordered), decided=decided),)
    return (Switch(arms=(*early, replace(last, body=())), decided=decided), *last.body)


def _rank(arm: Arm) -> int:
    if not falls(arm.body):
        return 0 if isinstance(arm.body[0], Jump) else 1
    return 2 if arm.body else 3


def without_last_continue(body: Sequence[Step]) -> Body:
    """A loop's body, where falling off its end does what the last step says."""
    return tuple(body[:-1]) if body and body[-1] == Continue() else tuple(body)


def steps(body: Body) -> Iterator[Step]:
    """Yield every step of a function, in order, without those of a fork's branches."""
    for step in body:
        yield step
        match step:
            case Loop(body=inner):
                yield from steps(inner)
            case Switch(arms=arms):
                for arm in arms:
                    yield from steps(arm.body)
            case Dispatch(cases=cases):
                for case in cases:
                    yield from steps(case.body)
            case _:
                pass


def nodes(body: Body) -> Iterator[Node]:
    """Yield the blocks that a function calls, and those for which it waits."""
    for step in steps(body):
        match step:
            case Call(node=node) | Join(gate=node):
                yield node
            case Watch(watchers=watchers):
                yield from watchers
            case _:
                pass


def branches(body: Body) -> Iterator[Branch]:
    """Yield the branches of every fork that are functions, each before those of the forks in it."""
    for step in steps(body):
        if isinstance(step, Join):
            for branch in (branch for branch in step.branches if not branch.idle):
                yield branch
                yield from branches(branch.body)
