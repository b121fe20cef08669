"""Optimised packages with one mistake each, of the kinds that a pass could make, what it emits, or the wait."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING, Any

from pluto_fleet.shared.flow.run import watch
from pluto_fleet.shared.time.future import Future
from plutoc.block import Gate, Param
from plutoc.check.model import Checked
from plutoc.compile import planned
from plutoc.plan.build import build
from plutoc.plan.model import (
    Arm,
    Body,
    Break,
    Call,
    Continue,
    End,
    Join,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc.plan.optimise import PASSES
from plutoc.plan.passes.clones import clones
from plutoc.plan.passes.constants import constants
from plutoc.plan.rewrite import Replace, rewritten
from plutoc_blocks.timer_monitor.step import timer_limit
from tests.equivalence.campaign import Contender

if TYPE_CHECKING:
    from pluto_fleet.shared.domain.status import Status
    from pluto_fleet.shared.flow.run import Branch, Run
    from pluto_fleet.shared.trips.flight import Flight, Limit

Pass = Callable[[Plan], Plan]

MUTANTS: dict[str, tuple[int, Contender]] = {}
"""By what is wrong with each, with the number of the first graph that shows it."""


def after_all(graph: int) -> Callable[[Replace], Replace]:
    """Make a change after all passes."""

    def known(change: Replace) -> Replace:
        name = change.__name__.replace("_", " ")
        MUTANTS[name] = graph, Contender(
            planner=lambda checked: rewritten(planned(checked), change)
        )
        return change

    return known


def instead_of(mended: Pass, graph: int) -> Callable[[Pass], Pass]:
    """Run another pass in the place of one of ours."""

    def known(wrong: Pass) -> Pass:
        passes = [wrong if one is mended else one for one in PASSES]
        assert passes != list(PASSES)

        def plan(checked: Checked) -> Plan:
            return reduce(lambda found, one: one(found), passes, build(checked))

        MUTANTS[wrong.__name__.replace("_", " ")] = graph, Contender(planner=plan)
        return wrong

    return known


@after_all(0)
def two_arms_of_a_switch_are_swapped(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(first, second, *rest)) if first.body != second.body:
            swapped = Arm(statuses=first.statuses, body=second.body, to=second.to)
            other = Arm(statuses=second.statuses, body=first.body, to=first.to)
            return (replace(step, arms=(swapped, other, *rest)),)
    return (step,)


@after_all(0)
def a_fused_wait_has_no_limits(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=tuple(w for w in watchers if not w.block.limits)),)
    return (step,)


@after_all(4)
def branches_begin_in_the_wrong_order(step: Step, _: Step) -> Body:
    match step:
        case Join(branches=branches):
            return (replace(step, branches=branches[::-1]),)
    return (step,)


@after_all(0)
def hooks_that_leave_the_status_alone_are_dropped(step: Step, _: Step) -> Body:
    match step:
        case Call(node=node) if node.block.emits_by_hook and not (node.hook and node.hook.emits):
            return ()
    return (step,)


@after_all(0)
def a_way_out_of_a_loop_leads_round(step: Step, _: Step) -> Body:
    return (Continue(),) if isinstance(step, Break) else (step,)


@instead_of(clones, 18)
def no_arrow_to_a_gate_of_all_gets_a_clone(plan: Plan) -> Plan:
    """No matter what the others bring."""

    def idle(step: Step, _: Step) -> Body:
        match step:
            case Join(gate=gate, branches=branches) if gate.block.gate is Gate.ALL:
                spared = tuple(replace(each, idle=each.body == (End(),)) for each in branches)
                return (
                    (step,)
                    if all(each.idle for each in spared)
                    else (replace(step, branches=spared),)
                )
        return (step,)

    return rewritten(plan, idle)


@instead_of(constants, 0)
def a_parameter_that_is_given_is_left_out(plan: Plan) -> Plan:
    """It has a default, of another value."""
    left_out = [
        (node.name, name)
        for node in plan.checked.graph.nodes
        for name in getattr(node.block.step, "__kwdefaults__", None) or {}
        if isinstance(node.block.param(name), Param)
    ]
    return replace(plan, left_out=tuple(left_out))


async def leave_the_rest(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """Let the first pass a gate, and forget to call the other branches off."""
    first: Future[Any] = Future()
    for clone in run.fork(status, branches):
        clone.watch(first.set)
    arrived: Status = (await first).result()
    return arrived


def never_let_go(run: Run[Any], *limits: Limit | None) -> Flight:
    """Wait with limits that go on when the wait is called off."""
    taskless = copy(run)
    taskless.task = None
    return watch(taskless, *limits)


def limit_by_default(
    run: Run[Any], *, default: float | None = None, safe_time: float | None = None
) -> Limit | None:
    """Let the declared default settle it, and forget the mission's own safe time."""
    return timer_limit(run, default=default, safe_time=default)


MUTANTS["a gate forgets to call the others off"] = (
    4,
    Contender(overrides={"pass_first": leave_the_rest}),
)
MUTANTS["a wait that is called off forgets to cancel its limits"] = (
    8,
    Contender(overrides={"watch": never_let_go}),
)
MUTANTS["a declared default hides the mission's own safe time"] = (
    5,
    Contender(overrides={"timer_limit": limit_by_default}),
)
