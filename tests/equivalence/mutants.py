"""Optimised packages with one mistake each, of the kinds that a pass could make."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING, Any

from plutoc.block import Gate
from plutoc.check.model import Checked
from plutoc.compile import planned
from plutoc.plan.build import build
from plutoc.plan.model import Arm, Body, Call, End, Join, Plan, Step, Switch, Watch
from plutoc.plan.optimise import PASSES
from plutoc.plan.passes.watch import watch as watch_pass
from plutoc.plan.rewrite import Replace, rewritten
from plutoc_blocks.timer_monitor.step import timer_limit
from plutoc_runtime.watching import watch
from tests.equivalence.campaign import Contender, Planner

if TYPE_CHECKING:
    from plutoc_runtime.flight import Flight
    from plutoc_runtime.run import Branch, Run
    from plutoc_runtime.status import Status
    from plutoc_runtime.watching import Limit


def _then(change: Replace) -> Planner:
    """Return a planner that makes a change after all passes."""
    return lambda checked: rewritten(planned(checked), change)


def _instead(mended: Callable[[Plan], Plan], wrong: Callable[[Plan], Plan]) -> Planner:
    """Return a planner with another pass in the place of one of ours."""
    passes = [wrong if one is mended else one for one in PASSES]
    assert passes != list(PASSES)

    def plan(checked: Checked) -> Plan:
        return reduce(lambda found, one: one(found), passes, build(checked))

    return plan


def _swap_arms(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(first, second, *rest)) if first.body != second.body:
            swapped = Arm(statuses=first.statuses, body=second.body, to=second.to)
            other = Arm(statuses=second.statuses, body=first.body, to=first.to)
            return (replace(step, arms=(swapped, other, *rest)),)
    return (step,)


def _drop_guard(step: Step, _: Step) -> Body:
    """What the first arm takes falls to the last."""
    match step:
        case Switch(arms=(_, second, *rest)):
            return (replace(step, arms=(second, *rest)),)
    return (step,)


def _drop_limits(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=tuple(w for w in watchers if not w.block.limits)),)
    return (step,)


def _turn_limits_round(step: Step, _: Step) -> Body:
    match step:
        case Watch(watchers=watchers):
            return (replace(step, watchers=watchers[::-1]),)
    return (step,)


def _turn_branches_round(step: Step, _: Step) -> Body:
    match step:
        case Join(branches=branches):
            return (replace(step, branches=branches[::-1]),)
    return (step,)


def _drop_quiet_hooks(step: Step, _: Step) -> Body:
    """A modifier that leaves the status alone looks as if it could go."""
    match step:
        case Call(node=node) if node.block.emits_by_hook and not (node.hook and node.hook.emits):
            return ()
    return (step,)


def _fuse_first_with_a_bare_arrow(plan: Plan) -> Plan:
    """Fuse as if a branch without a block brought nothing, at the gate of the first too."""

    def without(step: Step, _: Step) -> Body:
        match step:
            case Join(gate=gate, branches=branches) if gate.block.gate is Gate.FIRST:
                busy = tuple(branch for branch in branches if branch.body != (End(),))
                return (replace(step, branches=busy),) if busy else (step,)
        return (step,)

    return watch_pass(rewritten(plan, without))


def _fuse_over_hooks(plan: Plan) -> Plan:
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


def _watches(step: Step) -> bool:
    return isinstance(step, Call) and step.node.block.watches


async def _pass_first_and_leave_the_rest(
    run: Run[Any], status: Status, *branches: Branch[Any]
) -> Status:
    """A gate that forgets to call the other branches off."""
    from plutoc_runtime.signals import Signal

    first: Signal[Any] = Signal()
    for clone in run.fork(status, branches):
        clone.watch(first.set)
    arrived: Status = (await first).result()
    return arrived


async def _wait_for_any(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """A funnel that lets the first pass."""
    from plutoc_blocks.gate_fifo.step import pass_first

    return await pass_first(run, status, *branches)


def _watch_and_never_let_go(run: Run[Any], *limits: Limit | None) -> Flight:
    """A wait whose limits go on when it is called off."""
    nobody = copy(run)
    nobody.task = None
    return watch(nobody, *limits)


def _limit_by_default(
    run: Run[Any], *, default: float | None = None, safe_time: float | None = None
) -> Limit | None:
    """The declared default settled, and the mission's own safe time forgotten."""
    return timer_limit(run, default=default, safe_time=default)


MUTANTS: Mapping[str, Contender] = {
    "two arms of a switch are swapped": Contender(planner=_then(_swap_arms)),
    "a guard is dropped": Contender(planner=_then(_drop_guard)),
    "a fused wait has no limits": Contender(planner=_then(_drop_limits)),
    "a fused wait has its limits the wrong way round": Contender(planner=_then(_turn_limits_round)),
    "branches begin in the wrong order": Contender(planner=_then(_turn_branches_round)),
    "hooks that leave the status alone are dropped": Contender(planner=_then(_drop_quiet_hooks)),
    "a bare arrow to the gate of the first is forgotten": Contender(
        planner=_instead(watch_pass, _fuse_first_with_a_bare_arrow)
    ),
    "a wait is fused over a hook": Contender(planner=_instead(watch_pass, _fuse_over_hooks)),
    "a gate forgets to call the others off": Contender(
        overrides={"pass_first": _pass_first_and_leave_the_rest}
    ),
    "a funnel lets the first pass": Contender(overrides={"wait_for_all": _wait_for_any}),
    "a wait that is called off forgets to cancel its limits": Contender(
        overrides={"watch": _watch_and_never_let_go}
    ),
    "a declared default hides the mission's own safe time": Contender(
        overrides={"timer_limit": _limit_by_default}
    ),
}
"""By what is wrong with each."""
