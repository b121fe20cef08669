"""Verify a plan by abstract interpretation: each step must do what the graph says.

The states are pairs of the block that was left and the status on leaving it. Each step must continue where
the graph's edges lead that pair.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from plutoc.block import IN_GRAPH
from plutoc.check.model import Checked, Fork
from plutoc.graph.model import END, START, Node
from plutoc.plan import errors
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

ENTERS, ARRIVED = "interrupted at ", "arrived at "
"""Pseudo-blocks for interrupted missions that have not reached a block yet."""

Left = dict[tuple[str, Status], None]
"""Blocks that were left, and with which status: an ordered set."""


@dataclass(frozen=True, kw_only=True)
class _Frame:
    """The function being visited, and the jumps found in its innermost loop."""

    where: str
    to: str
    """Where the function ends: `end`, or a gate."""
    ends: Left = field(default_factory=dict)
    continued: Left = field(default_factory=dict)
    broken: Left = field(default_factory=dict)
    gone: dict[str, Left] = field(default_factory=dict)
    """What came to each label."""


@dataclass(kw_only=True)
class _Walk:
    """The state of the verification."""

    checked: Checked
    carried: Mapping[tuple[str, str], frozenset[Status]]
    forks: Mapping[tuple[str, Status], Fork]
    called: dict[str, None] = field(default_factory=dict)
    entered: dict[str, None] = field(default_factory=dict)
    """Blocks to which interrupted missions came, and to nothing before."""
    switched: dict[int, tuple[str, Switch, set[Status]]] = field(default_factory=dict)
    """By identity: two switches may be equal and stand in different places."""

    def function(self, body: Body, left: Left, where: str, to: str) -> Left:
        """Visit a whole function; return its final states."""
        frame = _Frame(where=where, to=to)
        self.body(body, left, frame)
        return frame.ends

    def body(self, body: Body, left: Left, frame: _Frame) -> Left:
        for step in body:
            left = self.step(step, left, frame) if left else left
        return left

    def step(self, step: Step, left: Left, frame: _Frame) -> Left:
        """Visit a step; return what falls off its end."""
        match step:
            case Call():
                self.moves(left, step.node.name, frame)
                return self.leave(step.node, {status: None for _, status in left})
            case Join():
                return self.join(step, left, frame)
            case Watch():
                return self.step(step.instead, left, frame)
            case Switch():
                walked = self.enter if step.enters else self.switch
                return walked(step, left, frame)
            case Arrived():
                return {(_arrived(source), status): None for source, status in left}
            case Loop():
                return self.loop(step, left, frame)
            case Dispatch():
                self.dispatch(step, left, frame)
            case Continue():
                frame.continued.update(left)
            case Break():
                frame.broken.update(left)
            case Goto():
                frame.gone.setdefault(step.label, {}).update(left)
            case End():
                self.moves(left, frame.to, frame)
                frame.ends.update(left)
        return {}

    def moves(self, left: Left, target: str, frame: _Frame) -> None:
        """Check that missions go on to a block, a gate or the end by an edge of the graph."""
        for source, status in left:
            edge = status in self.carried.get((source, target), ())
            implicit = target == END and (source, status) in self.checked.implicit_ends
            if not edge and not implicit:
                raise errors.no_edge(frame.where, source, target, status)
            if source.startswith((ENTERS, ARRIVED)):
                self.entered[target] = None
        if target != END:
            self.called[target] = None

    def leave(self, node: Node, arriving: Mapping[Status, None]) -> Left:
        known = self.checked.leaves[node.name]
        emitted = {s for status in arriving for s in node.emitted(status) if s in known}
        return {(node.name, status): None for status in IN_GRAPH if status in emitted}

    def join(self, step: Join, left: Left, frame: _Frame) -> Left:
        targets: dict[Status, None] = {}
        for source, status in left:
            fork = self.forks.get((source, status))
            if fork is None or (step.fork.name, step.gate.name) != (source, fork.gate):
                raise errors.no_fork(frame.where, source, status)
            if [_first(b.body, fork.gate) for b in step.branches] != [
                edge.target for edge in fork.branches
            ]:
                raise errors.other_branches(frame.where, source, status)
            brought = [self.branch(b, source, status, fork.gate) for b in step.branches]
            passed = let_through(step.gate.block.gate, brought)
            targets.update((s, None) for s in IN_GRAPH if s in passed)
        return self.leave(step.gate, targets)

    def branch(self, branch: Branch, source: str, status: Status, gate: str) -> frozenset[Status]:
        where = f"branch {branch.name}"
        ends = self.function(branch.body, {(source, status): None}, where, gate)
        if not ends:
            raise errors.branch_never_ends(where)
        return frozenset(status for _, status in ends)

    def switch(self, step: Switch, left: Left, frame: _Frame) -> Left:
        _, _, seen = self.switched.setdefault(id(step), (frame.where, step, set()))
        out: Left = {}
        rest = dict(left)
        for arm in step.arms:
            taken: Left = {pair: None for pair in left if pair[1] in arm.statuses}
            seen.update(status for _, status in taken)
            rest = {pair: None for pair in rest if pair not in taken}
            out.update(self.body(arm.body, taken, frame))
        for _, status in rest:
            raise errors.no_arm(frame.where, status)
        for source, status in left:
            if source.startswith((ENTERS, ARRIVED)):
                raise errors.asked_before(frame.where, source, status)
        return out

    def enter(self, step: Switch, left: Left, frame: _Frame) -> Left:
        """Walk on where those go on that were interrupted, and the others where they begin."""
        out: Left = {}
        for arm in step.arms:
            out.update(
                self.body(
                    arm.body,
                    {pair: None for pair in left if _place(pair[0]) in arm.places},
                    frame,
                )
            )
        for source, _ in left:
            if not any(_place(source) in arm.places for arm in step.arms):
                raise errors.no_way_in(frame.where, source)
        return out

    def loop(self, step: Loop, left: Left, frame: _Frame) -> Left:
        known: Left = {}
        while not left.keys() <= known.keys():
            known |= left
            inside = replace(frame, continued={}, broken={})
            fallen = self.body(step.body, known, inside)
            left = known | fallen | inside.continued
        return inside.broken

    def dispatch(self, step: Dispatch, left: Left, frame: _Frame) -> None:
        frame.gone[step.start] = {pair: None for pair in left if _place(pair[0]) is None}
        for pair in left:
            place = _place(pair[0])
            if place in step.entries:
                frame.gone.setdefault(place, {})[pair] = None
        known: dict[str, Left] = {case.label: {} for case in step.cases}
        while any(known[label].keys() != gone.keys() for label, gone in frame.gone.items()):
            for case in step.cases:
                known[case.label] = dict(frame.gone.get(case.label, {}))
                self.body(case.body, known[case.label], frame)
        for label, came in known.items():
            if not came:
                raise errors.never_reached(frame.where, f"case {label}")


def _place(source: str) -> Place:
    """Return where a mission goes on that is still on its way there."""
    return source.removeprefix(ENTERS) if source.startswith(ENTERS) else None


def _arrived(source: str) -> str:
    place = _place(source)
    return source if place is None else ARRIVED + place


def _first(body: Body, gate: str) -> str:
    """Return the place that a branch comes to first."""
    match body[:1]:
        case (Call() as call,) | (Watch(instead=Call() as call),):
            return call.node.name
        case (Loop() as loop,):
            return loop.head
        case (Dispatch() as step,):
            return step.start
        case _:
            return gate


def verify_paths(plan: Plan, where: str) -> None:
    """Raise `BadPlan` if some mission would not go as the graph says, or if a step is idle."""
    checked = plan.checked
    carried: dict[tuple[str, str], frozenset[Status]] = {}
    for edge, statuses in checked.carries.items():
        pair = (edge.source, edge.target)
        carried[pair] = carried.get(pair, frozenset()) | statuses
    forks = {(fork.node, fork.status): fork for fork in checked.forks}
    walked = _Walk(checked=checked, carried=carried, forks=forks)
    begin: Left = {(START, Status.UNEXECUTED): None}
    for name, statuses in checked.entries.items():
        carried[ENTERS + name, name] = carried[ARRIVED + name, name] = statuses
        begin.update(((ENTERS + name, status), None) for status in IN_GRAPH if status in statuses)
    walked.function(plan.body, begin, where, END)
    for name in checked.entries:
        if name not in walked.entered:
            raise errors.never_entered(where, name)
    for place, step, seen in walked.switched.values():
        for arm in step.arms:
            for status in arm.statuses:
                if step.decided and status not in seen:
                    raise errors.idle_arm(place, status)
    missed = [n.name for n in checked.graph.nodes if checked.arrives[n.name]]
    missed = [name for name in missed if name not in walked.called]
    if missed:
        raise errors.not_called(missed)
