"""Data-flow analysis: the statuses that can arrive at each switch of a plan.

Only statuses are propagated, and a step is visited again only for a new one: that is fast for any plan. What leaves a block is what it can give for what arrived, and no more than
the checks have seen to leave it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from plutoc.check.model import Checked
from plutoc.graph.model import Node
from plutoc.plan.chart import let_through
from plutoc.plan.model import (
    Arrived,
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
    Place,
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc_runtime.domain.status import Status

Statuses = frozenset[Status]


class Resuming(NamedTuple):
    """An interrupted mission that has not reached the block where it resumes."""

    place: str
    status: Status


Coming = frozenset[Status | Resuming]
"""The states that reach a step."""
Brought = Mapping[tuple[int, Status], Statuses]
"""What a branch, by its identity, brings to its gate when a mission forks with a status."""
NONE = frozenset[Status]()
NOTHING: Coming = frozenset()


@dataclass(slots=True, kw_only=True, eq=False)
class _Frame:
    """The function being visited, and the jumps found in its innermost loop."""

    ends: set[Status] = field(default_factory=set)
    continued: set[Status | Resuming] = field(default_factory=set)
    broken: set[Status | Resuming] = field(default_factory=set)
    gone: dict[str, Coming] = field(default_factory=dict)
    """What came to each label."""
    known: dict[int, tuple[set[Status | Resuming], set[Status | Resuming]]] = field(
        default_factory=dict
    )
    """For each loop, by identity: what came to its head, and what leaves it by `Break`."""


class _Walk:
    def __init__(self, checked: Checked) -> None:
        self.checked = checked
        self.found: dict[int, set[Status]] = {}
        self.brought: dict[tuple[int, Status], Statuses] = {}

    def body(self, body: Body, coming: Coming, frame: _Frame) -> Coming:
        for step in body:
            coming = self.step(step, coming, frame) if coming else NOTHING
        return coming

    def step(self, step: Step, coming: Coming, frame: _Frame) -> Coming:
        """Visit a step; return what falls off its end."""
        match step:
            case Call(node=node):
                return self.leave(node, _at(node, coming))
            case Join():
                return self.join(step, _statuses(coming))
            case Watch(instead=instead):
                return self.step(instead, coming, frame)
            case Switch():
                return (
                    self.enter(step, coming, frame)
                    if step.enters
                    else self.switch(step, _statuses(coming), frame)
                )
            case Arrived():
                return coming
            case Loop():
                return self.loop(step, coming, frame)
            case Dispatch():
                self.dispatch(step, coming, frame)
            case Continue():
                frame.continued.update(coming)
            case Break():
                frame.broken.update(coming)
            case Goto(label=label):
                frame.gone[label] = frame.gone.get(label, NOTHING) | coming
            case End():
                frame.ends.update(_statuses(coming))
        return NOTHING

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

    def switch(self, step: Switch, statuses: Statuses, frame: _Frame) -> Coming:
        self.found.setdefault(id(step), set()).update(statuses)
        out = NOTHING
        for arm in step.arms:
            out |= self.body(arm.body, statuses.intersection(arm.statuses), frame)
        return out

    def enter(self, step: Switch, coming: Coming, frame: _Frame) -> Coming:
        out = NOTHING
        for arm in step.arms:
            some = (one for one in coming if _place(one) in arm.places)
            out |= self.body(arm.body, frozenset(some), frame)
        return out

    def loop(self, step: Loop, coming: Coming, frame: _Frame) -> Coming:
        known, broken = frame.known.setdefault(id(step), (set(), set()))
        while not coming <= known:
            known |= coming
            inside = replace(frame, continued=set(), broken=broken)
            coming = self.body(step.body, frozenset(known), inside) | inside.continued
        return frozenset(broken)

    def dispatch(self, step: Dispatch, coming: Coming, frame: _Frame) -> None:
        bodies = {case.label: case.body for case in step.cases}
        walked: dict[str, Coming] = {}
        frame.gone[step.start] = _statuses(coming)
        for one in coming:
            if isinstance(one, Resuming):
                frame.gone[one.place] = frame.gone.get(one.place, NOTHING) | {one}
        while fresh := [label for label, came in frame.gone.items() if walked.get(label) != came]:
            for label in fresh:
                walked[label] = frame.gone[label]
                self.body(bodies[label], walked[label], frame)


def _statuses(coming: Iterable[Status | Resuming]) -> Statuses:
    return frozenset(one for one in coming if isinstance(one, Status))


def _at(node: Node, coming: Coming) -> Statuses:
    """Return what reaches a block, with missions that resume there."""
    here = (one.status for one in coming if isinstance(one, Resuming) and one.place == node.name)
    return _statuses(coming).union(here)


def _place(one: Status | Resuming) -> Place:
    return one.place if isinstance(one, Resuming) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Reaching:
    """The result of the analysis."""

    switches: Mapping[int, set[Status]]
    """What can arrive at each, by its identity."""
    brought: Brought


def reaching_statuses(plan: Plan) -> Reaching:
    """Analyse a plan with all possible statuses."""
    walk = _Walk(plan.checked)
    begin = frozenset[Status | Resuming]((Status.UNEXECUTED,))
    entering = (
        Resuming(place, status)
        for place, statuses in plan.checked.entries.items()
        for status in statuses
    )
    walk.body(plan.body, begin.union(entering), _Frame())
    return Reaching(switches=walk.found, brought=walk.brought)
