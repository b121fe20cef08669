"""Replace an outer loop around another loop by a second call of the block before the inner one.

Before:                             After:
    loop wait                           call wait
      call wait                         loop allocate
      loop allocate                       call allocate
        call allocate                     …
        …                                 switch
        switch                              STANDBY -> allocate: continue
          COMPLETED -> again: break         FAILED -> end: end
          FAILED -> end: end                COMPLETED -> again: go on
          STANDBY -> allocate: go on      call again
      call again                          switch
      switch                                COMPLETED -> end: end
        COMPLETED -> end: end               STANDBY -> wait: go on
        STANDBY -> wait: go on            call wait

Two loops in one another, with a `break` that means "go round in the other one", become one loop that
reads from top to bottom. And an arrow that is led to the block before the loop, or away from there,
changes its own line and not the indentation of half the flow: people review what has changed. For
the same reason the ways of a switch stand in the order of the source, as if there had been one loop.

There may be a few blocks before the inner loop. It stays as it is where more than three further calls
would be needed, and where several ways leave the inner loop for something behind it, which would have
to be written for each of them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import takewhile

from plutoc.check.model import Checked
from plutoc.plan.bodies import falls, without_last_continue
from plutoc.plan.model import (
    Arm,
    Body,
    Break,
    Call,
    Continue,
    End,
    Goto,
    Join,
    Loop,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc.plan.rewrite import rewritten

MOST_CALLS = 3
"""The most additional calls."""

_JUMPS: tuple[type[Step], ...] = (End, Goto, Break, Continue)
"""In the order in which ways that only jump stand in a switch."""


def straight(plan: Plan) -> Plan:
    """Replace outer loops by further calls of the blocks between outer and inner loop."""
    return rewritten(plan, lambda step, _: _straightened(step, plan.checked))


def _straightened(step: Step, checked: Checked) -> Body:
    if not isinstance(step, Loop):
        return (step,)
    first = tuple(takewhile(lambda one: isinstance(one, Call), step.body))
    loop, *behind = step.body[len(first) :] or (None,)
    if not isinstance(loop, Loop):
        return (step,)
    ways = _count(loop.body, Break)
    round_again = (*first, Continue())
    onward = _changed(tuple(behind), Continue, round_again)
    if falls(onward):
        onward += round_again
    if (
        not ways
        or (behind and ways > 1)
        or ways * _count(onward, Continue) * len(first) > MOST_CALLS
    ):
        return (step,)
    body = _changed(loop.body, Break, onward)
    settled = _settled((*body, Continue()) if falls(body) else body, checked)
    return *first, replace(loop, body=without_last_continue(settled))


def _changed(body: Body, jump: type[Step], onward: Body) -> Body:
    """Return a body with other steps for each jump of its own loop, not of loops in it."""
    return tuple(new for step in body for new in _change(step, jump, onward))


def _change(step: Step, jump: type[Step], onward: Body) -> Body:
    if isinstance(step, jump):
        return onward
    if isinstance(step, Switch):
        arms = (replace(arm, body=_changed(arm.body, jump, onward)) for arm in step.arms)
        return (replace(step, arms=tuple(arms)),)
    return (step,)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Way:
    """A way of a switch, all of it."""

    arm: Arm
    body: Body
    size: int

    @property
    def weight(self) -> tuple[int, int]:
        """How much it holds; of mere jumps, going round weighs most."""
        if len(self.body) == 1 and isinstance(self.body[0], _JUMPS):
            return _JUMPS.index(type(self.body[0])), 0
        return len(_JUMPS), self.size


def _settled(body: Body, checked: Checked) -> Body:
    """Return a body that leads elsewhere, with the heaviest way of each switch behind it."""
    behind: Body = ()
    size = 0  # of what stands behind: to count it anew at each switch would take too long
    for before, step in zip((None, *body)[-2::-1], reversed(body), strict=True):
        match step:
            case Switch(arms=(*early, last)) if _parts(step, behind):
                bodies = [(arm, _settled(arm.body, checked)) for arm in early]
                ways = [_Way(arm=arm, body=body, size=_size(body)) for arm, body in bodies]
                whole = _settled(last.body, checked)
                ways.append(_Way(arm=last, body=behind or whole, size=size or _size(whole)))
                main = max(reversed(ways), key=lambda way: way.weight)
                ways.sort(key=lambda way: _place(before, way.arm, checked))
                arms = [replace(way.arm, body=way.body) for way in ways if way is not main]
                step = replace(step, arms=(*arms, replace(main.arm, body=())))
                behind = main.body
                size = 1 + sum(way.size for way in ways)
            case _:
                size += _size((step,))
        behind = (step, *behind)
    return behind


def _parts(step: Switch, behind: Body) -> bool:
    """Do all ways of a switch lead elsewhere, the last perhaps by what stands behind it?"""
    *early, last = step.arms
    return not any(falls(arm.body) for arm in early) and bool(behind) is not bool(last.body)


def _place(before: Step | None, arm: Arm, checked: Checked) -> int:
    """Return which of its arrows the block before a switch sends an arm's statuses along."""
    match before:
        case Watch(instead=Call(node=node) | Join(gate=node)) | Call(node=node) | Join(gate=node):
            edges = checked.graph.outgoing[node.name]
            found = (n for n, edge in enumerate(edges) if checked.carries[edge] & {*arm.statuses})
            return next(found, len(edges))
        case _:
            return 0


def _count(body: Body, jump: type[Step]) -> int:
    """Return how many such jumps of its own loop a body has."""
    return sum(
        (
            sum(_count(arm.body, jump) for arm in step.arms)
            if isinstance(step, Switch)
            else isinstance(step, jump)
        )
        for step in body
    )


def _size(body: Body) -> int:
    return sum(1 + sum(_size(one) for one in _inside(step)) for step in body)


def _inside(step: Step) -> tuple[Body, ...]:
    match step:
        case Switch(arms=arms):
            return tuple(arm.body for arm in arms)
        case Loop(body=body):
            return (body,)
        case _:
            return ()
