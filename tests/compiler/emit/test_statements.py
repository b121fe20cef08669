"""Lines of Python do what the steps of a plan say."""

from __future__ import annotations

from importlib.abc import InspectLoader
from itertools import count
from types import ModuleType
from typing import Any

import hypothesis.strategies as st
from hypothesis import given, settings

from plutoc.block import ANY_SAME, IN_GRAPH, Block, Gate
from plutoc.emit.embed import Carried
from plutoc.emit.statements import Scope, body_lines
from plutoc.graph.model import Node
from plutoc.plan.bodies import branches, falls
from plutoc.plan.model import (
    Arm,
    Body,
    Branch,
    Break,
    Call,
    Case,
    Continue,
    Dispatch,
    End,
    Goto,
    Join,
    Loop,
    Step,
    Switch,
)
from plutoc.source import Span
from plutoc_runtime.domain.status import Status

NUMBERS = count()

Trace = list[tuple[str, Status]]


class OutOfScript(Exception):
    """All statuses of the script are used up."""


class World:
    """What blocks do: they note that a mission came, and send it on as a script says."""

    def __init__(self, script: list[Status]) -> None:
        self.script, self.trace = iter(script), Trace()

    def step(self, block: str, status: Status) -> Status:
        self.trace.append((block, status))
        for following in self.script:
            return following
        raise OutOfScript


def step(run: World, status: Status, *, block: str) -> Status:
    return run.step(block, status)


def gate(run: World, status: Status, *branches: Any, block: str) -> Status:
    for branch in branches:
        status = branch(run, status)
    return run.step(block, status)


def node(name: str, kind: Gate | None = None) -> Node:
    block = Block(
        name="X",
        doc="",
        step=step if kind is None else gate,
        transitions=ANY_SAME,
        named=True,
        gate=kind,
    )
    span = Span(0, 0)
    return Node(
        name=name,
        block=block,
        package="std",
        values=(),
        choices=(),
        hook=None,
        passed=(),
        declaration=f"{name} = X",
        span=span,
        name_span=span,
    )


NODES = st.integers(0, 9).map(lambda number: Call(node=node(f"n{number}")))


@st.composite
def joins(draw: st.DrawFn) -> Join:
    number = next(NUMBERS)  # no two forks of a flow share a function
    ways = tuple(
        Branch(name=f"_b{number}_{place}", path="a -> b -> c", body=(*draw(bodies(2)), End()))
        for place in range(2)
    )
    return Join(fork=node("fork"), gate=node(f"gate{number}", Gate.FIRST), branches=ways)


@st.composite
def switches(draw: st.DrawFn, depth: int, jumps: tuple[Step, ...]) -> Switch:
    order = draw(st.permutations(IN_GRAPH))
    cuts = sorted(draw(st.sets(st.integers(1, 4), min_size=1, max_size=3)))
    parts = [order[a:b] for a, b in zip([0, *cuts], [*cuts, 5], strict=True)]
    decided = draw(st.booleans())
    if not decided:  # then a status that no arm takes is possible, and an arm may be alone
        parts = parts[draw(st.integers(0, 1)) :]
    return Switch(
        arms=tuple(
            Arm(statuses=tuple(part), to="n0", body=draw(bodies(depth - 1, jumps)))
            for part in parts
        ),
        decided=decided,
    )


@st.composite
def bodies(draw: st.DrawFn, depth: int, jumps: tuple[Step, ...] = ()) -> Body:
    """A body whose steps never stand behind a jump."""
    steps: list[Step] = []
    for _ in range(draw(st.integers(0, 3))):
        if depth > 0 and draw(st.booleans()):
            inner = draw(bodies(depth - 1, (Continue(), Break(), End())))
            loop = Loop(head="n0", body=(Call(node=node("head")), *inner))
            options = [switches(depth, jumps), st.just(loop)]
            steps.append(draw(st.one_of(*options, joins()) if depth > 2 else st.one_of(*options)))
        else:
            steps.append(draw(NODES))
        if not falls(tuple(steps)):
            return tuple(steps)
    ends = st.booleans() if jumps else st.just(False)
    if draw(ends):
        steps.append(draw(st.sampled_from(jumps)))
    return tuple(steps)


@st.composite
def dispatches(draw: st.DrawFn) -> Dispatch:
    labels = ("a", "b", "c")
    ways: tuple[Step, ...] = (End(), *(Goto(label=label) for label in labels))
    cases = []
    for label in labels:
        inner: list[Step] = [draw(NODES), draw(switches(1, ways))]
        if falls(tuple(inner)):
            inner.append(draw(st.sampled_from(ways)))
        cases.append(Case(label=label, body=tuple(inner)))
    return Dispatch(start="b", cases=tuple(cases))


class Leave(Exception):
    """A jump out of a body."""

    def __init__(self, step: Step, status: Status) -> None:
        self.step, self.status = step, status


def interpret(body: Body, world: World, status: Status) -> Status:
    """Do what the steps say, one by one."""
    for one in body:
        match one:
            case Call(node=called):
                status = world.step(called.name, status)
            case Join(gate=closing, branches=ways):
                for way in ways:
                    status = function(way.body, world, status)
                status = world.step(closing.name, status)
            case Switch(arms=arms):
                taken = [arm for arm in arms if status in arm.statuses]
                if not taken:
                    raise AssertionError(status)
                status = interpret(taken[0].body, world, status)
            case Loop(body=inner):
                status = looped(inner, world, status)
            case Dispatch(start=label, cases=cases):
                places = {case.label: case.body for case in cases}
                while True:
                    try:
                        interpret(places[label], world, status)
                    except Leave as jump:
                        if not isinstance(jump.step, Goto):
                            raise
                        label, status = jump.step.label, jump.status
            case _:
                raise Leave(one, status)
    return status


def looped(body: Body, world: World, status: Status) -> Status:
    while True:
        try:
            status = interpret(body, world, status)
        except Leave as jump:
            status = jump.status
            if isinstance(jump.step, Break):
                return status
            if not isinstance(jump.step, Continue):
                raise


def function(body: Body, world: World, status: Status) -> Status:
    try:
        interpret(body, world, status)
    except Leave as jump:
        assert isinstance(jump.step, End)
        return jump.status
    raise AssertionError("fell off the end")


def written(body: Body) -> str:
    """Return a module with a function for the body and one for each branch."""
    functions = {"flow": body, **{branch.name: branch.body for branch in branches(body)}}
    names = {Carried(package="std", function=one): one.__name__ for one in (step, gate)}
    scope = Scope(names=names, fields={}, left_out=frozenset(), mission="mission")
    text = ""
    for name, inner in functions.items():
        lines = "".join(f"    {line}\n" for line in body_lines(inner, scope))
        text += f"def {name}(run, status):\n{lines}\n"
    return text


def result(call: Any, world: World) -> tuple[Status | None, Trace]:
    try:
        return call(), world.trace
    except OutOfScript:
        return None, world.trace
    except AssertionError as error:
        (astray,) = error.args
        assert isinstance(astray, Status)
        return None, [*world.trace, ("astray", astray)]


def whole(body: Body) -> Body:
    return (*body, End()) if falls(body) else body


SCRIPTS = st.lists(st.sampled_from(IN_GRAPH), max_size=30)


class Text(InspectLoader):
    """Loads a module from its text."""

    def __init__(self, text: str) -> None:
        self._text = text

    def get_source(self, fullname: str) -> str:
        return self._text


def agree(body: Body, script: list[Status]) -> None:
    """Hold what the lines do against what the steps say."""
    flow = ModuleType("flow")
    vars(flow).update(step=step, gate=gate, **{each.name: each for each in Status})
    Text(written(body)).exec_module(flow)
    told, done = World(script), World(script)
    first = Status.UNEXECUTED
    assert result(lambda: flow.flow(done, first), done) == result(
        lambda: function(body, told, first), told
    )


@settings(max_examples=50)
@given(bodies(3).map(whole), SCRIPTS)
def test_structured_flow_does_what_its_plan_says(body: Body, script: list[Status]) -> None:
    """Loops, switches, forks and early ways out visit the same blocks with the same statuses."""
    agree(body, script)


@settings(max_examples=40)
@given(dispatches(), SCRIPTS)
def test_dispatch_does_what_its_plan_says(body: Dispatch, script: list[Status]) -> None:
    """A flow without structure jumps from case to case."""
    agree((body,), script)
