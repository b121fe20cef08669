"""Two walks of one mission, with the same luck: along the graph, and through the plan.

Neither knows anything of how plans are made. Each notes every block, every branch and every gate
that it comes to, with the status there. Both may begin where an interrupted mission goes on.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

from plutoc.block import IN_GRAPH, Gate
from plutoc.check.model import Checked
from plutoc.graph.model import END, START, Node
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
from plutoc_runtime.domain.status import WORST_FIRST, Status


class Enough(Exception):
    """The walk is long enough."""


@dataclass(kw_only=True)
class Diary:
    """What happened, and what will: the same seed chooses the same."""

    luck: random.Random
    steps: int
    place: Place = None
    """Where the mission goes on, as long as the plan remembers it."""
    lines: list[str] = field(default_factory=list)

    def note(self, what: str, status: Status) -> None:
        self.lines.append(f"{what} {status.value}")
        if len(self.lines) == self.steps:
            raise Enough

    def call(self, node: Node, status: Status) -> Status:
        self.note(node.name, status)
        emitted = node.emitted(status)
        return self.luck.choice([s for s in IN_GRAPH if s in emitted])

    def close(self, gate: Node, brought: Sequence[Status]) -> Status:
        if gate.block.gate is Gate.ALL:
            return self.call(gate, min(brought, key=WORST_FIRST.index))
        return self.call(gate, self.luck.choice(list(brought)))


def kept(walk: Callable[[Diary], None], seed: int, steps: int = 80) -> list[str]:
    """Return the diary of a walk that this seed chooses."""
    diary = Diary(luck=random.Random(seed), steps=steps)
    with suppress(Enough):
        walk(diary)
    return diary.lines


def along_graph(
    checked: Checked, diary: Diary, place: Place = None, status: Status = Status.UNEXECUTED
) -> None:
    """Walk the graph, from its beginning or from a block."""
    (first,) = checked.graph.outgoing[START]
    _from(checked, place or first.target, status, END, diary)


def _from(checked: Checked, name: str, status: Status, to: str, diary: Diary) -> Status:
    gates = {(fork.node, fork.status): fork.gate for fork in checked.forks}
    closed = False
    while closed or name not in (to, END):
        node = checked.graph.node[name]
        if not closed:
            status = diary.call(node, status)
        closed = False
        taken = [e for e in checked.graph.outgoing[name] if status in e.takes]
        if len(taken) > 1:
            gate = gates[name, status]
            brought = []
            for edge in taken:
                diary.note(f"branch to {edge.target}", status)
                brought.append(_from(checked, edge.target, status, gate, diary))
            status = diary.close(checked.graph.node[gate], brought)
            name, closed = gate, True
        else:
            name = taken[0].target if taken else END
    diary.note(f"at {name}", status)
    return status


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
