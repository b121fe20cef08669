"""Send no clone into a branch that contributes nothing, or that never begins.

Before:                                     After:
    join tell -> all                            join tell -> all
      branch _note: tell -> note -> all           branch _note: tell -> note -> all
        call note                                   call note
        end                                         end
      branch _all: tell -> all                    no branch for tell -> all
        end

Of what comes to a gate that waits for all branches, the worst status passes. A branch that is only
an arrow brings the status of the fork; where another one always brings the same or a worse one, it
makes no difference. A gate that lets the first branch pass gets it at once from such a branch, at the
latest: those behind it are called off before they begin.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

from plutoc.block import IN_GRAPH, Gate
from plutoc.plan.model import Body, Branch, End, Join, Plan, Step
from plutoc.plan.reaching_statuses import Brought, reaching_statuses
from plutoc.plan.rewrite import rewritten
from plutoc_runtime.domain.status import WORST_FIRST


def clones(plan: Plan) -> Plan:
    """Send clones only where they have an effect."""

    @cache
    def brought() -> Brought:
        return reaching_statuses(plan).brought

    def spared(step: Step, before: Step) -> Body:
        if not isinstance(step, Join) or not isinstance(before, Join):
            return (step,)
        arrows = [n for n, branch in enumerate(before.branches) if branch.body == (End(),)]
        idle = _idle(before, arrows, brought) if arrows else ()
        branches = (
            replace(branch, idle=branch.idle or n in idle) for n, branch in enumerate(step.branches)
        )
        return (replace(step, branches=tuple(branches)),) if idle else (step,)

    return rewritten(plan, spared)


def _idle(join: Join, arrows: list[int], brought: Callable[[], Brought]) -> Sequence[int]:
    """Return the numbers of the branches that need no clone."""
    if join.gate.asks:  # a gate of another package may count them
        return ()
    if join.gate.block.gate is Gate.FIRST:
        return range(arrows[0] + 1, len(join.branches))
    busy = [branch for number, branch in enumerate(join.branches) if number not in arrows]
    return arrows if any(_as_bad(branch, brought()) for branch in busy) else arrows[1:]


def _as_bad(branch: Branch, brought: Brought) -> bool:
    """Whether a branch always brings the status of its fork, or a worse one."""
    pairs = [
        (status, after) for status in IN_GRAPH for after in brought.get((id(branch), status), ())
    ]
    return bool(pairs) and all(
        WORST_FIRST.index(after) <= WORST_FIRST.index(status) for status, after in pairs
    )
