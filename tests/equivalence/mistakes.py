"""Mistakes that a pass could make, or what it emits, or the wait that it emits."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from pluto_fleet.shared.flow.run import watch
from pluto_fleet.shared.time.future import Future
from plutoc.block import Gate, Param
from plutoc.plan.model import (
    Arm,
    Body,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Join,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc.plan.passes.watch import watch as watch_pass
from plutoc.plan.rewrite import rewritten
from plutoc_blocks.gate_fifo.step import pass_first
from plutoc_blocks.timer_monitor.step import timer_limit

if TYPE_CHECKING:
    from pluto_fleet.shared.domain.status import Status
    from pluto_fleet.shared.flow.run import Branch, Run
    from pluto_fleet.shared.trips.flight import Flight, Limit


def swap_arms(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(first, second, *rest)) if first.body != second.body:
            swapped = Arm(statuses=first.statuses, body=second.body, to=second.to)
            other = Arm(statuses=second.statuses, body=first.body, to=first.to)
            return (replace(step, arms=(swapped, other, *rest)),)
    return (step,)


def drop_guard(step: Step, _: Step) -> Body:
    """What the first arm takes falls to the last."""
    match step:
        case Switch(arms=(_, second, *rest)):
            return (replace(step, arms=(second, *rest)),)
    return (step,)


def drop_limits(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=tuple(w for w in watchers if not w.block.limits)),)
    return (step,)


def turn_limits_round(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=watchers[::-1]),)
    return (step,)


def turn_branches_round(step: Step, _: Step) -> Body:
    match step:
        case Join(branches=branches):
            return (replace(step, branches=branches[::-1]),)
    return (step,)


def drop_quiet_hooks(step: Step, _: Step) -> Body:
    """A modifier that leaves the status alone looks as if it could go."""
    match step:
        case Call(node=node) if node.block.emits_by_hook and not (node.hook and node.hook.emits):
            return ()
    return (step,)


def fuse_first_with_a_bare_arrow(plan: Plan) -> Plan:
    """Fuse as if a branch without a block brought nothing, at the gate of the first too."""

    def without(step: Step, _: Step) -> Body:
        match step:
            case Join(gate=gate, branches=branches) if gate.block.gate is Gate.FIRST:
                busy = tuple(branch for branch in branches if branch.body != (End(),))
                return (replace(step, branches=busy),) if busy else (step,)
        return (step,)

    return watch_pass(rewritten(plan, without))


def fuse_over_hooks(plan: Plan) -> Plan:
    """Fuse as if a hook beside a monitor did nothing."""

    def without(step: Step, _: Step) -> Body:
        match step:
            case Join(branches=branches):
                waiting = tuple(
                    branch
                    for branch in branches
                    if all(isinstance(each, End) or _watches(each) for each in branch.body)
                )
                return (replace(step, branches=waiting),) if waiting else (step,)
        return (step,)

    return watch_pass(rewritten(plan, without))


def spare_the_first_arrow(plan: Plan) -> Plan:
    """Spare the bare arrow to a gate of the first as well, not only what stands behind it."""
    return _spared(plan, Gate.FIRST)


def spare_every_arrow(plan: Plan) -> Plan:
    """Spare every bare arrow to a gate that waits for all, no matter what the others bring."""
    return _spared(plan, Gate.ALL)


def _spared(plan: Plan, kind: Gate) -> Plan:
    def idle(step: Step, _: Step) -> Body:
        match step:
            case Join(gate=gate, branches=branches) if gate.block.gate is kind:
                bare = [branch.body == (End(),) for branch in branches]
                if all(bare):
                    return (step,)
                pairs = zip(branches, bare, strict=True)
                spared = tuple(replace(branch, idle=idle) for branch, idle in pairs)
                return (replace(step, branches=spared),)
        return (step,)

    return rewritten(plan, idle)


def leave_out_what_has_a_default(plan: Plan) -> Plan:
    """Leave a parameter out that has a default, of any value."""
    left_out = [
        (node.name, name)
        for node in plan.checked.graph.nodes
        for name in getattr(node.block.step, "__kwdefaults__", None) or {}
        if isinstance(node.block.param(name), Param)
    ]
    return replace(plan, left_out=tuple(left_out))


def go_round_instead(step: Step, _: Step) -> Body:
    """A way out of a loop leads to its beginning."""
    return (Continue(),) if isinstance(step, Break) else (step,)


def exchange_cases(step: Step, _: Step) -> Body:
    match step:
        case Dispatch(cases=(first, second, *rest)):
            exchanged = replace(first, body=second.body), replace(second, body=first.body)
            return (replace(step, cases=(*exchanged, *rest)),)
    return (step,)


def _watches(step: Step) -> bool:
    return isinstance(step, Call) and step.node.block.watches


async def pass_first_and_leave_the_rest(
    run: Run[Any], status: Status, *branches: Branch[Any]
) -> Status:
    """A gate that forgets to call the other branches off."""
    first: Future[Any] = Future()
    for clone in run.fork(status, branches):
        clone.watch(first.set)
    arrived: Status = (await first).result()
    return arrived


async def wait_for_any(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """A funnel that lets the first pass."""
    return await pass_first(run, status, *branches)


def watch_and_never_let_go(run: Run[Any], *limits: Limit | None) -> Flight:
    """A wait whose limits go on when it is called off."""
    taskless = copy(run)
    taskless.task = None
    return watch(taskless, *limits)


def limit_by_default(
    run: Run[Any], *, default: float | None = None, safe_time: float | None = None
) -> Limit | None:
    """The declared default settled, and the mission's own safe time forgotten."""
    return timer_limit(run, default=default, safe_time=default)
