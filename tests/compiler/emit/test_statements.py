"""The lines of a flow do what its plan says: random graphs, entered anywhere, walked in both."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from importlib.abc import InspectLoader
from random import Random
from types import ModuleType, SimpleNamespace
from typing import Any

import hypothesis.strategies as st
import pytest
from hypothesis import given, settings

from plutoc.diagnostic import Rejected
from plutoc.emit.embed import Carried
from plutoc.emit.statements import Scope, body_lines
from plutoc.plan.bodies import branches, steps
from plutoc.plan.build import build
from plutoc.plan.model import Join, Place, Plan
from plutoc.plan.optimise import stages
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import KINDS, checked
from tests.compiler.check.walks import Diary, kept
from tests.compiler.plan.graphs import GRAPHS, random_graphs
from tests.compiler.plan.walks import entered_anywhere, goes_on, through_plan


@dataclass(kw_only=True)
class Run:
    """A mission that notes where it comes, and is sent on as its diary says."""

    plan: Plan
    diary: Diary
    at: Place
    state: Any = field(default_factory=SimpleNamespace)
    """Where it waits is noted there."""


def step(run: Run, status: Status, *ways: Any, block: str, **_: object) -> Status:
    node = run.plan.checked.graph.node[block]
    if not node.block.gate:
        return run.diary.call(node, status)
    functions = {way.__name__: way for way in ways}
    bodies = (run.plan.body, *(branch.body for branch in branches(run.plan.body)))
    joins = (one for body in bodies for one in steps(body) if isinstance(one, Join))
    (join,) = {
        one.branches
        for one in joins
        if one.gate.name == block and {b.name for b in one.branches if not b.idle} == {*functions}
    }
    brought = []
    for branch in join:
        run.diary.note(f"branch to {branch.path.split(' -> ')[1]}", status)
        brought.append(status if branch.idle else functions[branch.name](run, status))
        run.diary.note(f"at {block}", brought[-1])
    return run.diary.close(node, brought)


@pytest.fixture(scope="module", autouse=True)
def blocks() -> Iterator[None]:
    """Let all blocks have this step, which gets their names."""
    with pytest.MonkeyPatch.context() as patch:
        for name, kind in KINDS.items():
            plain = replace(kind, params=(), needs=(), uses=(), limit=None)
            patch.setitem(KINDS, name, replace(plain, step=step, named=True))
        yield


class Text(InspectLoader):
    """Loads a module from its text."""

    def __init__(self, text: str) -> None:
        self._text = text

    def get_source(self, fullname: str) -> str:
        return self._text


def written(plan: Plan) -> ModuleType:
    """Return a module with a function for the plan and one for each branch."""
    functions = {"flow": plan.body, **{one.name: one.body for one in branches(plan.body)}}
    names = {Carried(package="std", function=step): step.__name__}
    scope = Scope(names=names, fields={}, left_out=frozenset(), mission="mission")
    text = ""
    for name, body in functions.items():
        lines = "".join(f"    {line}\n" for line in body_lines(body, scope))
        text += f"def {name}(run, status):\n{lines}\n"
    flow = ModuleType("flow")
    vars(flow).update(step=step, **{each.name: each for each in Status})
    Text(text).exec_module(flow)
    return flow


def through_flow(flow: ModuleType, plan: Plan, place: Place, status: Status, diary: Diary) -> None:
    """Call the flow as a plan is walked."""
    diary.note("at end", flow.flow(Run(plan=plan, diary=diary, at=place), status))


def agree(text: str, seed: int) -> None:
    """Hold what the lines do against what the steps say."""
    graph = entered_anywhere(checked(text), Random(seed), 4)
    built, *_, last = (plan for _, plan in stages(build(graph)))
    for plan in (built, last):
        flow = written(plan)
        for place, status in ((None, Status.UNEXECUTED), *goes_on(graph)):
            told = kept(partial(through_plan, plan, place=place, status=status), seed)
            assert kept(partial(through_flow, flow, plan, place, status), seed) == told


@pytest.mark.parametrize("name", GRAPHS)
def test_a_flow_does_what_its_plan_says(name: str) -> None:
    """Loops, switches, forks, cases and early ways out visit the same blocks with the same statuses."""
    for seed in range(4):
        agree(GRAPHS[name], seed)


@settings(max_examples=40, deadline=None)
@given(text=random_graphs(), seed=st.integers(0, 1000))
def test_so_does_any_flow(text: str, seed: int) -> None:
    with suppress(Rejected):
        agree(text, seed)
