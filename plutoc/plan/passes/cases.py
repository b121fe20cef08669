"""Inline the cases of a dispatch where possible, and sort them by the number of jumps.

Before:                             After:
    dispatch from create                dispatch from create
      case create                         case launch
        call create                         call launch
        goto allocate                       call watch
      case allocate                         switch
        call allocate                         STANDBY -> allocate:
        goto launch                             call allocate
      case launch                               goto launch
        call launch                           …
        call watch                        case create
        switch                              call create
          STANDBY -> allocate: goto …       call allocate
          …                                 goto launch

A case of a few calls in a row is written where it is jumped to, and so is one that a single jump
leads to. `match` tries its cases one after the other: the fewer, and the sooner, the better.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace

from plutoc.plan.model import Body, Call, Dispatch, End, Goto, Plan, Step, Switch
from plutoc.plan.rewrite import rewritten, rewritten_body

SHORT = 2
"""The most calls of a case that may be duplicated."""


def cases(plan: Plan) -> Plan:
    """Inline short cases, and sort the others by the number of jumps."""
    return rewritten(plan, _fused)


def _fused(step: Step, _: Step) -> Body:
    if not isinstance(step, Dispatch):
        return (step,)
    while fused := _to_fuse(step):
        step = _without(step, fused)
    jumps = _jumps(step)
    ordered = sorted(step.cases, key=lambda case: -jumps[case.label])
    return (replace(step, cases=tuple(ordered)),)


def _to_fuse(dispatch: Dispatch) -> Mapping[str, Body]:
    """Return cases that can be inlined, none of which jumps to another of them."""
    jumps = _jumps(dispatch)
    found: dict[str, Body] = {}
    led_to = {dispatch.start, *dispatch.entries}
    for case in dispatch.cases:
        targets = set(_gotos(case.body))
        wanted = jumps[case.label] == 1 or _short(case.body)
        apart = case.label not in led_to | targets and not targets & found.keys()
        if wanted and apart:
            found[case.label] = case.body
            led_to |= targets
    return found


def _jumps(dispatch: Dispatch) -> Counter[str]:
    """Count the jumps to each case."""
    return Counter(label for case in dispatch.cases for label in _gotos(case.body))


def _gotos(body: Body) -> Iterator[str]:
    for step in body:
        match step:
            case Goto(label=label):
                yield label
            case Switch(arms=arms):
                for arm in arms:
                    yield from _gotos(arm.body)
            case _:
                pass


def _short(body: Body) -> bool:
    *calls, last = body
    in_a_row = len(calls) <= SHORT and all(isinstance(step, Call) for step in calls)
    return in_a_row and isinstance(last, Goto | End)


def _without(dispatch: Dispatch, fused: Mapping[str, Body]) -> Dispatch:
    def jumped(step: Step, _: Step) -> Body:
        return fused.get(step.label, (step,)) if isinstance(step, Goto) else (step,)

    rest = (
        replace(case, body=rewritten_body(case.body, jumped))
        for case in dispatch.cases
        if case.label not in fused
    )
    return replace(dispatch, cases=tuple(rest))
