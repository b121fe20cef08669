"""Optimised packages with one mistake each, of the kinds that a pass could make."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce

from plutoc.check.model import Checked
from plutoc.compile import planned
from plutoc.plan.build import build
from plutoc.plan.model import Plan
from plutoc.plan.optimise import PASSES
from plutoc.plan.passes.clones import clones
from plutoc.plan.passes.constants import constants
from plutoc.plan.passes.watch import watch
from plutoc.plan.rewrite import Replace, rewritten
from tests.equivalence import mistakes
from tests.equivalence.campaign import Contender, Planner


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


MUTANTS: Mapping[str, Contender] = {
    "two arms of a switch are swapped": Contender(planner=_then(mistakes.swap_arms)),
    "a guard is dropped": Contender(planner=_then(mistakes.drop_guard)),
    "a fused wait has no limits": Contender(planner=_then(mistakes.drop_limits)),
    "a fused wait has its limits the wrong way round": Contender(
        planner=_then(mistakes.turn_limits_round)
    ),
    "branches begin in the wrong order": Contender(planner=_then(mistakes.turn_branches_round)),
    "hooks that leave the status alone are dropped": Contender(
        planner=_then(mistakes.drop_quiet_hooks)
    ),
    "a bare arrow to the gate of the first is forgotten": Contender(
        planner=_instead(watch, mistakes.fuse_first_with_a_bare_arrow)
    ),
    "a wait is fused over a hook": Contender(planner=_instead(watch, mistakes.fuse_over_hooks)),
    "the arrow to a gate of the first gets no clone": Contender(
        planner=_instead(clones, mistakes.spare_the_first_arrow)
    ),
    "no arrow to a gate of all gets a clone": Contender(
        planner=_instead(clones, mistakes.spare_every_arrow)
    ),
    "a parameter that is given is left out": Contender(
        planner=_instead(constants, mistakes.leave_out_what_has_a_default)
    ),
    "a way out of a loop leads round": Contender(planner=_then(mistakes.go_round_instead)),
    "two cases are exchanged": Contender(planner=_then(mistakes.exchange_cases)),
    "a gate forgets to call the others off": Contender(
        overrides={"pass_first": mistakes.pass_first_and_leave_the_rest}
    ),
    "a funnel lets the first pass": Contender(overrides={"wait_for_all": mistakes.wait_for_any}),
    "a wait that is called off forgets to cancel its limits": Contender(
        overrides={"watch": mistakes.watch_and_never_let_go}
    ),
    "a declared default hides the mission's own safe time": Contender(
        overrides={"timer_limit": mistakes.limit_by_default}
    ),
}
"""By what is wrong with each."""
