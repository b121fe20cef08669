"""Merge two consecutive switches on the same status.

Before:                                     After:
    call m1                                     call m1
    switch                                      switch
      FAILED -> end: end                          FAILED -> end: end
      STANDBY, COMPLETED -> m2, m3: go on         STANDBY -> m2:
    switch                                          call m2
      STANDBY -> m2:                              COMPLETED -> m3: go on
        call m2
      COMPLETED -> m3: go on

That is so where one arm of the first goes on to the second and does nothing before, and the others
leave: between the two nothing can change the status.
"""

from __future__ import annotations

from dataclasses import replace

from plutoc.plan.bodies import falls
from plutoc.plan.model import Body, Plan, Step, Switch
from plutoc.plan.rewrite import rewritten_bodies


def switches(plan: Plan) -> Plan:
    """Merge consecutive switches."""
    return rewritten_bodies(plan, _joined)


def _joined(body: Body) -> Body:
    written: list[Step] = []
    for step in body:
        before = written[-1] if written else None
        if isinstance(before, Switch) and isinstance(step, Switch) and _leads_on(before, step):
            early = tuple(arm for arm in before.arms if arm.body)
            written[-1] = replace(step, arms=(*early, *step.arms))
        else:
            written.append(step)
    return body if len(written) == len(body) else tuple(written)


def _leads_on(before: Switch, step: Switch) -> bool:
    """Whether all statuses of a switch come unchanged from one arm of the switch before it."""
    if before.enters or step.enters:
        return False
    on = [arm for arm in before.arms if falls(arm.body)]
    if len(on) != 1 or on[0].body or not (before.decided and step.decided):
        return False
    return {status for arm in step.arms for status in arm.statuses} == set(on[0].statuses)
