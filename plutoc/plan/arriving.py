"""Which statuses can arrive at each switch of a plan.

Only statuses are walked with, and each step anew only if a further one comes to it: that is quick,
however large the plan. What leaves a block is what it can give for what arrived, and no more than
the checks have seen to leave it.
"""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.check.model import Checked
from plutoc.frozen import frozen
from plutoc.graph.model import Node
from plutoc.plan.chart import let_through
from plutoc.plan.model import (
    Body,
    Branch,
    Break,
    Call,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc_runtime.status import Status

Statuses = frozenset[Status]
Brought = Mapping[tuple[int, Status], Statuses]
"""What a branch, by its identity, brings to its gate when a mission forks with a status."""
NONE = frozenset[Status]()


class _Frame:
    """The function that is walked, and the jumps that were met in the innermost loop."""

    __slots__ = ("broken", "continued", "ends", "gone", "known")

    def __init__(self) -> None:
        self.ends: set[Status] = set()
        self.continued: set[Status] = set()
        self.broken: set[Status] = set()
        self.gone: dict[str, Statuses] = {}
        """What came to each label."""
        self.known: dict[int, tuple[set[Status], set[Status]]] = {}
        """For each loop, by identity: what came to its head, and what leaves it by `Break`."""

    def inside(self, broken: set[Status]) -> _Frame:
        """Return the same function, seen from inside a loop."""
        inner = _Frame()
        inner.ends, inner.gone, inner.known, inner.broken = self.ends, self.gone, self.known, broken
        return inner


class _Walk:
    def __init__(self, checked: Checked) -> None:
        self.checked = checked
        self.found: dict[int, set[Status]] = {}
        self.brought: dict[tuple[int, Status], Statuses] = {}

    def body(self, body: Body, statuses: Statuses, frame: _Frame) -> Statuses:
        for step in body:
            statuses = self.step(step, statuses, frame) if statuses else NONE
        return statuses

    def step(self, step: Step, statuses: Statuses, frame: _Frame) -> Statuses:
        """Walk a step; return what falls off its end."""
        match step:
            case Call(node=node):
                return self.leave(node, statuses)
            case Join():
                return self.join(step, statuses)
            case Watch(instead=instead):
                return self.step(instead, statuses, frame)
            case Switch():
                return self.switch(step, statuses, frame)
            case Loop():
                return self.loop(step, statuses, frame)
            case Dispatch():
                self.dispatch(step, statuses, frame)
            case Continue():
                frame.continued.update(statuses)
            case Break():
                frame.broken.update(statuses)
            case Goto(label=label):
                frame.gone[label] = frame.gone.get(label, NONE) | statuses
            case End():
                frame.ends.update(statuses)
        return NONE

    def leave(self, node: Node, statuses: Statuses) -> Statuses:
        given = NONE.union(*(node.emitted(status) for status in statuses))
        return given & self.checked.leaves[node.name]

    def join(self, step: Join, statuses: Statuses) -> Statuses:
        gate = step.gate.block.gate
        passed = NONE.union(
            *(let_through(gate, [self.brings(b, one) for b in step.branches]) for one in statuses)
        )
        return self.leave(step.gate, passed)

    def brings(self, branch: Branch, status: Status) -> Statuses:
        key = (id(branch), status)
        if key not in self.brought:
            frame = _Frame()
            self.body(branch.body, frozenset((status,)), frame)
            self.brought[key] = frozenset(frame.ends)
        return self.brought[key]

    def switch(self, step: Switch, statuses: Statuses, frame: _Frame) -> Statuses:
        self.found.setdefault(id(step), set()).update(statuses)
        out = NONE
        for arm in step.arms:
            out |= self.body(arm.body, statuses.intersection(arm.statuses), frame)
        return out

    def loop(self, step: Loop, statuses: Statuses, frame: _Frame) -> Statuses:
        known, broken = frame.known.setdefault(id(step), (set(), set()))
        while not statuses <= known:
            known |= statuses
            inside = frame.inside(broken)
            statuses = self.body(step.body, frozenset(known), inside) | inside.continued
        return frozenset(broken)

    def dispatch(self, step: Dispatch, statuses: Statuses, frame: _Frame) -> None:
        bodies = {case.label: case.body for case in step.cases}
        walked: dict[str, Statuses] = {}
        frame.gone[step.start] = statuses
        while fresh := [label for label, came in frame.gone.items() if walked.get(label) != came]:
            for label in fresh:
                walked[label] = frame.gone[label]
                self.body(bodies[label], walked[label], frame)


@frozen
class Arriving:
    """What was found."""

    switches: Mapping[int, set[Status]]
    """What can arrive at each, by its identity."""
    brought: Brought


def arriving(plan: Plan) -> Arriving:
    """Walk a plan with all statuses that can occur."""
    walk = _Walk(plan.checked)
    walk.body(plan.body, frozenset((Status.UNEXECUTED,)), _Frame())
    return Arriving(switches=walk.found, brought=walk.brought)
