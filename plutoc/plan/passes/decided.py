"""Drop the conditions of a switch that are certain.

Before:                                     After:
    call retry                                  call retry
    switch, asking all                          switch
      FAILED -> end: end                          FAILED -> end: end
      STANDBY -> allocate: go on                  STANDBY -> allocate: go on
    call allocate                               call allocate
    switch, asking all                          call launch
      STANDBY -> launch: go on
    call launch

The last arm becomes the default, and a switch with one arm becomes its body.
"""

from __future__ import annotations

from dataclasses import replace

from plutoc.plan.model import Body, Plan, Step, Switch
from plutoc.plan.rewrite import rewritten


def decided(plan: Plan) -> Plan:
    """Drop conditions that are certain."""
    return rewritten(plan, _decided)


def _decided(step: Step, _: Step) -> Body:
    match step:
        case Switch(arms=(only,)):
            return only.body
        case Switch():
            return (replace(step, decided=True),)
        case _:
            return (step,)
