"""The optimised package and the plain one leave the same trace; `python -m tests.equivalence` does
the same with many more graphs, and looks whether all occurs in them that can."""

from __future__ import annotations

from dataclasses import replace

import pytest

from plutoc.compile import planned
from plutoc.plan.model import Arm, Body, Break, Continue, Join, Step, Switch, Watch
from plutoc.plan.rewrite import Replace, rewritten
from tests.equivalence.campaign import one_graph

GRAPHS = 8
ENOUGH = 30
"""Graphs within which a mistake must have shown itself."""


@pytest.mark.parametrize("number", range(GRAPHS))
def test_optimised_and_plain_packages_leave_the_same_trace(number: int) -> None:
    found = one_graph(f"1/{number}")
    assert not found.findings, str(found.findings[0])
    assert found.events > 0


def two_arms_of_a_switch_are_swapped(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(first, second, *rest)) if first.body != second.body:
            swapped = Arm(statuses=first.statuses, body=second.body, to=second.to)
            other = Arm(statuses=second.statuses, body=first.body, to=first.to)
            return (replace(step, arms=(swapped, other, *rest)),)
    return (step,)


def a_fused_wait_has_no_limits(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=tuple(w for w in watchers if not w.block.limits)),)
    return (step,)


def branches_begin_in_the_wrong_order(step: Step, _: Step) -> Body:
    return (replace(step, branches=step.branches[::-1]),) if isinstance(step, Join) else (step,)


def a_way_out_of_a_loop_leads_round(step: Step, _: Step) -> Body:
    return (Continue(),) if isinstance(step, Break) else (step,)


@pytest.mark.parametrize(
    "mistake",
    [
        two_arms_of_a_switch_are_swapped,
        a_fused_wait_has_no_limits,
        branches_begin_in_the_wrong_order,
        a_way_out_of_a_loop_leads_round,
    ],
)
def test_a_mistake_that_a_pass_could_make_is_found(mistake: Replace) -> None:
    def wrong(number: int) -> bool:
        return bool(one_graph(f"1/{number}", lambda c: rewritten(planned(c), mistake)).findings)

    assert any(map(wrong, range(ENOUGH)))
