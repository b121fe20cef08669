"""A plan that leads interrupted missions elsewhere is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from plutoc.plan.build import build
from plutoc.plan.errors import BadPlan
from plutoc.plan.model import Arrived, Body, Call, Dispatch, End, Loop, Place, Plan, Step, Switch
from plutoc.plan.optimise import optimised
from plutoc.plan.rewrite import rewritten
from plutoc.plan.verify import verify
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import BASIC, checked
from tests.compiler.plan.graphs import LOOP_THAT_ASKS
from tests.compiler.plan.plans import CHAIN

GRAPH = checked(f"""{BASIC}
    wait = Clock
    start -> create -> wait -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end""")
GOOD = optimised(build(GRAPH))
ASKS = optimised(build(checked(LOOP_THAT_ASKS)))
CASES = build(checked(CHAIN))


def changed(change: Callable[[Step], Body], plan: Plan = GOOD) -> Plan:
    return rewritten(plan, lambda step, _: change(step))


def without(places: tuple[Place, ...]) -> Callable[[Step], Body]:
    """Ask for these places in no arm any more."""

    def change(step: Step) -> Body:
        if not isinstance(step, Switch) or not step.enters:
            return (step,)
        arms = (
            replace(arm, places=tuple(place for place in arm.places if place not in places))
            for arm in step.arms
        )
        return (replace(step, arms=tuple(arm for arm in arms if arm.places)),)

    return change


def swapped(step: Step) -> Body:
    """Lead those that go on where the others begin, and the other way round."""
    if not isinstance(step, Switch) or not step.enters:
        return (step,)
    one, two = step.arms
    return (replace(step, arms=(replace(one, places=two.places), replace(two, places=one.places))),)


def unasked(step: Step) -> Body:
    """Begin always."""
    enters = isinstance(step, Switch) and step.enters
    return step.arms[0].body if isinstance(step, Switch) and enters else (step,)


def twice(step: Step) -> Body:
    if not isinstance(step, Switch) or not step.enters:
        return (step,)
    one, two = step.arms
    return (replace(step, arms=(one, replace(two, places=(*two.places, *one.places)))),)


def of_a_status(step: Step) -> Body:
    """Ask in one arm for a place and for a status."""
    if not isinstance(step, Switch) or not step.enters:
        return (step,)
    one, two = step.arms
    return (replace(step, arms=(replace(one, statuses=(Status.STANDBY,)), two)),)


def of_no_place(step: Step) -> Body:
    """Add an arm that asks for nothing."""
    if not isinstance(step, Switch) or not step.enters:
        return (step,)
    return (replace(step, arms=(*step.arms, replace(step.arms[0], places=()))),)


def asked_before(step: Step) -> Body:
    """Ask for a mission's status in front of the loop, where some have come to no block yet."""
    if not isinstance(step, Loop):
        return (step,)
    inner = (s for s in step.body if isinstance(s, Switch))
    arm = next(inner).arms[-1]
    statuses = (Status.UNEXECUTED, Status.STANDBY)
    return Switch(arms=(replace(arm, statuses=statuses, body=()),)), step


def forgetful(step: Step) -> Body:
    return () if isinstance(step, Arrived) else (step,)


def of_no_entry(step: Step) -> Body:
    return (replace(step, entries=()),) if isinstance(step, Dispatch) else (step,)


def of_another_entry(step: Step) -> Body:
    cases = (
        (case for case in step.cases if case.label != "wait7") if isinstance(step, Dispatch) else ()
    )
    return (replace(step, cases=tuple(cases)),) if isinstance(step, Dispatch) else (step,)


@pytest.mark.parametrize("plan", [GOOD, ASKS, CASES], ids=["good", "asks", "cases"])
def test_the_plans_that_are_spoilt_here_are_good(plan: Plan) -> None:
    """Else the other tests would prove nothing."""
    verify(plan)


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        (changed(without(("allocate",))), "astray that allocate lies behind"),
        (changed(without(("wait",))), "astray that wait lies behind"),
        (changed(without((None,))), "astray that the beginning lies behind"),
        (changed(swapped), "no edge leads|astray"),
        (changed(unasked), "from interrupted at allocate no edge leads UNEXECUTED to create"),
        (changed(twice), "two arms are for"),
        (changed(of_a_status), "a switch needs two arms"),
        (changed(of_no_place), "a switch needs two arms"),
        (changed(asked_before), "interrupted at allocate is asked for its status"),
        (changed(forgetful, ASKS), "astray that second lies behind"),
        (changed(of_no_entry, CASES), "no way leads an interrupted mission to allocate"),
        (changed(of_another_entry, CASES), "there is no case wait7"),
    ],
)
def test_a_spoilt_entry_is_refused(plan: Plan, message: str) -> None:
    """One mistake, one sentence."""
    with pytest.raises(BadPlan, match=message):
        verify(plan)


def test_an_entry_that_leads_to_an_end_is_none() -> None:
    """No mission that goes on at the allocator ever comes there."""

    def ended(step: Step) -> Body:
        return (End(),) if isinstance(step, Call) and step.node.name == "allocate" else (step,)

    with pytest.raises(BadPlan, match="no edge leads"):
        verify(changed(ended))
