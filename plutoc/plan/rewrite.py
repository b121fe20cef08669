"""A plan with some of its steps replaced: what a pass does, without the way to each step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from plutoc.plan.bodies import falls
from plutoc.plan.model import Body, Dispatch, Join, Loop, Plan, Step, Switch

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
        for new in change(_inside(step, change), step):
            written.append(new)
            if not falls((new,)):
                return tuple(written)
    return tuple(written)


def _inside(step: Step, change: Replace) -> Step:
    match step:
        case Join(branches=branches):
            changed = (replace(b, body=rewritten_body(b.body, change)) for b in branches)
            return replace(step, branches=tuple(changed))
        case Switch(arms=arms):
            inner = (replace(arm, body=rewritten_body(arm.body, change)) for arm in arms)
            return replace(step, arms=tuple(inner))
        case Loop(body=body):
            return replace(step, body=rewritten_body(body, change))
        case Dispatch(cases=cases):
            new = (replace(case, body=rewritten_body(case.body, change)) for case in cases)
            return replace(step, cases=tuple(new))
        case _:
            return step
