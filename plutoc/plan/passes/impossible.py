"""Remove impossible statuses from switches, and arms without any status.

Before:                                     After:
    call retry                                  call retry
    switch, asking all                          switch, asking all
      COMPLETED, FAILED -> end: end               FAILED -> end: end
      STANDBY -> allocate: go on                  STANDBY -> allocate: go on

A guard says what its edge takes; the checks have seen what really comes. Which it is depends on the
way as well: behind one fork a block may leave with statuses that it never has behind another, and
where a block is written twice, not all that comes to it comes to each. What is never reached then
goes, and a loop that is never begun again is none.
"""

from __future__ import annotations

from dataclasses import replace

from plutoc.plan.bodies import breaks, continues, falls
from plutoc.plan.model import Body, Loop, Plan, Step, Switch
from plutoc.plan.reaching_statuses import reaching_statuses
from plutoc.plan.rewrite import rewritten


def impossible(plan: Plan) -> Plan:
    """Remove statuses that cannot arrive."""
    found = reaching_statuses(plan).switches

    def narrowed(step: Step, before: Step) -> Body:
        if isinstance(step, Loop) and not any(
            leave(step.body) for leave in (falls, continues, breaks)
        ):
            return step.body
        if not isinstance(step, Switch) or step.enters:
            return (step,)
        came = found.get(id(before), set())
        if came.issuperset(status for arm in step.arms for status in arm.statuses):
            return (step,)
        arms = (
            replace(arm, statuses=tuple(s for s in arm.statuses if s in came)) for arm in step.arms
        )
        return (replace(step, arms=tuple(arm for arm in arms if arm.statuses)),)

    return rewritten(plan, narrowed)
