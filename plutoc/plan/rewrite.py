"""Rewriting a plan bottom-up: the traversal that passes share.

Unchanged parts stay the same objects.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from operator import is_
from typing import TypeVar

from plutoc.plan.bodies import falls
from plutoc.plan.model import Arm, Body, Branch, Case, Dispatch, Join, Loop, Plan, Step, Switch

T = TypeVar("T", Arm, Branch, Case)

Replace = Callable[[Step, Step], Body]
"""Gives what stands in a step's place, from the step with its inside replaced, and from the step
as it was: what is known of it is known by its identity."""


def rewritten(plan: Plan, change: Replace) -> Plan:
    """Return the plan with each step replaced, those of branches too, inner ones first."""
    return replace(plan, body=rewritten_body(plan.body, change))


def rewritten_body(body: Body, change: Replace) -> Body:
    """Return a body with each step replaced, inner ones first; what is never reached then goes."""
    written: list[Step] = []
    for step in body:
        inside = _with(step, lambda inner: rewritten_body(inner, change))
        for new in change(inside, step):
            written.append(new)
            if new is not step and not falls((new,)):
                return tuple(written)
    return body if _same(written, body) else tuple(written)


def rewritten_bodies(plan: Plan, change: Callable[[Body], Body]) -> Plan:
    """Return the plan with each body replaced, those of branches too, inner ones first."""

    def deep(body: Body) -> Body:
        written = tuple(_with(step, deep) for step in body)
        return change(body if _same(written, body) else written)

    return replace(plan, body=deep(plan.body))


def _with(step: Step, change: Callable[[Body], Body]) -> Step:
    """Return a step with each body in it replaced."""
    match step:
        case Join(branches=branches):
            ways = tuple(_part(branch, change) for branch in branches)
            return step if _same(ways, branches) else replace(step, branches=ways)
        case Switch(arms=arms):
            inner = tuple(_part(arm, change) for arm in arms)
            return step if _same(inner, arms) else replace(step, arms=inner)
        case Dispatch(cases=cases):
            new = tuple(_part(case, change) for case in cases)
            return step if _same(new, cases) else replace(step, cases=new)
        case Loop(body=body):
            changed = change(body)
            return step if changed is body else replace(step, body=changed)
        case _:
            return step


def _part(part: T, change: Callable[[Body], Body]) -> T:
    body = change(part.body)
    return part if body is part.body else replace(part, body=body)


def _same(new: Sequence[object], old: Sequence[object]) -> bool:
    return len(new) == len(old) and all(map(is_, new, old))
