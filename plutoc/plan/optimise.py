"""The passes over a plan, in their order."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from plutoc.plan.model import Plan
from plutoc.plan.passes.cases import cases
from plutoc.plan.passes.clones import clones
from plutoc.plan.passes.constants import constants
from plutoc.plan.passes.decided import decided
from plutoc.plan.passes.impossible import impossible
from plutoc.plan.passes.straight import straight
from plutoc.plan.passes.switches import switches
from plutoc.plan.passes.watch import watch

PASSES: tuple[Callable[[Plan], Plan], ...] = (
    impossible,
    decided,
    switches,
    cases,
    watch,
    clones,
    constants,
    straight,
)
"""Each has its reasons in its file. A pass may rely on those before it."""

BUILT = "built"
"""What the plan is called before the first pass."""


def optimised(plan: Plan) -> Plan:
    """Return a plan that does the same with less."""
    for each in PASSES:
        plan = each(plan)
    return plan


def stages(plan: Plan) -> Iterator[tuple[str, Plan]]:
    """Yield the plan as it is now, and as it is after each pass, by name."""
    yield BUILT, plan
    for each in PASSES:
        plan = each(plan)
        yield each.__name__, plan
