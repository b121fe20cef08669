"""A switch asks nothing that is settled already.

Before:                                     After:
    call retry                                  call retry
    switch, asking all                          switch
      FAILED -> end: end                          FAILED -> end: end
      STANDBY -> allocate: go on                  STANDBY -> allocate: go on
    call allocate                               call allocate
    switch, asking all                          call launch
      STANDBY -> launch: go on
    call launch

The last arm takes what the others leave, and where there is only one arm, nothing is asked at all.
"""

from __future__ import annotations

from dataclasses import replace

from plutoc.plan.model import Body, Plan, Step, Switch
from plutoc.plan.rewrite import rewritten


def decided(plan: Plan) -> Plan:
    """Ask no question that has one answer."""
    return rewritten(plan, _decided)


def _decided(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(only,)):
            return only.body
        case Switch():
            return (replace(step, decided=True),)
        case _:
            return (step,)
