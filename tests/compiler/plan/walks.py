"""Walks through plans, and where missions may go on that were interrupted.

The walk knows nothing of how plans are made. It notes what the one along the graph notes.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

from plutoc.block import IN_GRAPH
from plutoc.check.model import Checked
from plutoc.graph.model import END, START
from plutoc.plan.chart import Charts, Kind
from plutoc.plan.model import (
    Arrived,
    Body,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Place,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc_runtime.domain.status import Status
from tests.compiler.check.walks import Diary


def goes_on(checked: Checked) -> list[tuple[str, Status]]:
    """Return where interrupted missions go on, and with which status."""
    return [
        (name, s) for name, statuses in checked.entries.items() for s in IN_GRAPH if s in statuses
    ]


def entered_anywhere(checked: Checked, luck: Random, most: int) -> Checked:
    """Return the graph as if missions went on at some of its blocks, with all that comes there."""
    (first,) = checked.graph.outgoing[START]
    chart = Charts(checked).chart(first.target, checked.carries[first])
    blocks = [spot for spot in chart.arrives if spot.kind is Kind.BLOCK and spot != chart.entry]
    chosen = luck.sample(blocks, min(len(blocks), luck.randint(1, most)))
    node = checked.graph.node
    made = {name: came for name, came in checked.entries.items() if node[name].block.creates}
    return replace(checked, entries={**made, **{s.name: chart.arrives[s] for s in chosen}})


def through_plan(
    plan: Plan, diary: Diary, place: Place = None, status: Status = Status.UNEXECUTED
) -> None:
    """Walk the plan, from its beginning or as a mission that goes on at a block."""
    diary.place = place
    _function(plan.body, status, END, diary)


def _function(body: Body, status: Status, to: str, diary: Diary) -> Status:
    jump, status = _body(body, status, diary)
    assert isinstance(jump, End)
    diary.note(f"at {to}", status)
    return status


def _body(body: Body, status: Status, diary: Diary) -> tuple[Step | None, Status]:
    """Walk a body; return the jump that leaves it, if one does, and the status."""
    for step in body:
        jump, status = _step(step, status, diary)
        if jump is not None:
            return jump, status
    return None, status


def _step(step: Step, status: Status, diary: Diary) -> tuple[Step | None, Status]:
    match step:
        case Call():
            return None, diary.call(step.node, status)
        case Join():
            brought = []
            for branch in step.branches:
                diary.note(f"branch to {branch.path.split(' -> ')[1]}", status)
                brought.append(_function(branch.body, status, step.gate.name, diary))
            return None, diary.close(step.gate, brought)
        case Arrived():
            diary.place = None
            return None, status
        case Switch() if step.enters:
            (arm,) = (arm for arm in step.arms if diary.place in arm.places)
            return _body(arm.body, status, diary)
        case Switch():
            asked = step.arms[:-1] if step.decided else step.arms
            taken = [arm for arm in asked if status in arm.statuses]
            if step.decided:  # the last arm takes what is left, as generated code will do it
                taken.append(step.arms[-1])
            return _body(taken[0].body, status, diary)
        case Watch():
            return _step(step.instead, status, diary)
        case Loop():
            while True:
                jump, status = _body(step.body, status, diary)
                if isinstance(jump, Break):
                    return None, status
                if jump is not None and not isinstance(jump, Continue):
                    return jump, status
        case Dispatch():
            bodies = {case.label: case.body for case in step.cases}
            label = (diary.place if step.entries else None) or step.start
            while True:
                jump, status = _body(bodies[label], status, diary)
                if not isinstance(jump, Goto):
                    return jump, status
                label = jump.label
        case _:
            return step, status
