"""A plan that is wrong in one place is refused, and the message says where."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import pytest

from plutoc.plan.bodies import steps
from plutoc.plan.errors import BadPlan
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
    Plan,
    Step,
    Switch,
    Watch,
)
from plutoc.plan.rewrite import rewritten, rewritten_body
from plutoc.plan.verify import verify
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS, routes
from tests.compiler.plan.plans import after, structured

GRAPH = checked(routes(a="STANDBY > b, COMPLETED > end, FAILED > end", b="STANDBY > a"))
FORKED = structured(GRAPHS["a fork before the first launch"])
FREE = structured(GRAPHS["a maze"])


def call(name: str) -> Call:
    return Call(node=GRAPH.graph.node[name])


def arm(body: Body, *names: str) -> Arm:
    return Arm(statuses=tuple(Status(name) for name in names), body=body, to="somewhere")


def loop(*body: Arm, behind: Body = ()) -> Body:
    """The plan of `GRAPH`, but for the arms after its first block."""
    inside = (call("a"), Switch(arms=body, decided=True), call("b"))
    return (call("create"), Loop(head="a", body=inside), *behind)


ENDS = arm((End(),), "COMPLETED", "FAILED")
ON = arm((), "STANDBY")
GOOD = loop(ENDS, ON)

WRONG: dict[str, tuple[Body, str]] = {
    "a body without an end": ((call("create"),), "without a jump"),
    "steps behind a jump": ((call("create"), End(), call("a")), "never reached"),
    "continue outside of a loop": ((call("create"), Continue()), "continue outside of a loop"),
    "continue in a case": (
        (Dispatch(start="a", cases=(Case(label="a", body=(call("create"), Continue())),)),),
        "continue outside of a loop",
    ),
    "break outside of a loop": ((call("create"), Break()), "break outside of a loop"),
    "goto outside of a dispatch": ((call("create"), Goto(label="a")), "outside of a dispatch"),
    "a dispatch behind a step": (
        (call("create"), Dispatch(start="a", cases=())),
        "not the whole of its body",
    ),
    "one arm": (loop(arm((), "STANDBY", "COMPLETED", "FAILED")), "two arms"),
    "an arm without a status": (loop(ENDS, ON, arm((End(),))), "each with a status"),
    "two arms for one status": (loop(ENDS, arm((), "STANDBY", "FAILED")), "two arms take FAILED"),
    "no arm for a status": (loop(arm((End(),), "COMPLETED"), ON), "no arm takes FAILED"),
    "an arm that nothing takes": (
        loop(ENDS, arm((), "STANDBY", "RUNNING")),
        "takes RUNNING, which never arrives",
    ),
    "a way that the graph has not": (
        loop(ENDS, arm((Continue(),), "STANDBY")),
        "never reached",
    ),
    "another block next": (
        loop(ENDS, arm((call("a"),), "STANDBY")),
        "from a no edge leads STANDBY to a",
    ),
    "an end where the mission goes on": (
        loop(arm((End(),), "STANDBY", "COMPLETED"), arm((), "FAILED")),
        "from a no edge leads STANDBY to end",
    ),
    "blocks that nothing leads to": (
        (call("create"), Loop(head="a", body=(Continue(),))),
        "missions can reach what the plan never does: a, b",
    ),
    "a block left out": (
        (call("create"), Loop(head="a", body=(call("a"), Switch(arms=(ENDS, ON), decided=True)))),
        "from a no edge leads STANDBY to a",
    ),
}


def test_the_plan_that_is_spoilt_here_is_good() -> None:
    """Else the other tests would prove nothing."""
    verify(Plan(checked=GRAPH, body=GOOD))


@pytest.mark.parametrize("name", WRONG)
def test_a_spoilt_plan_is_refused(name: str) -> None:
    """One mistake, one sentence."""
    body, message = WRONG[name]
    with pytest.raises(BadPlan, match=message):
        verify(Plan(checked=GRAPH, body=body))


def spoilt_join(**changes: Any) -> Plan:
    """The plan of a graph with a fork, with something else in the join's first branch."""
    first, join, *rest = FORKED.body
    assert isinstance(join, Join)
    left, right = join.branches
    spoilt = Branch(
        name=changes.get("name", left.name),
        path=left.path,
        body=changes.get("body", left.body),
    )
    branches = (right, left) if "swapped" in changes else (spoilt, right)
    return replace(FORKED, body=(first, replace(join, branches=branches), *rest))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "_right"}, "two branches are called _right"),
        ({"name": "print"}, "not a private name"),
        ({"name": "__left"}, "not a private name"),
        ({"name": "_"}, "not a private name"),
        ({"name": "_le-ft"}, "not a private name"),
        ({"body": (Continue(),)}, "branch _left: continue outside of a loop"),
        ({"body": (Loop(head="left", body=(Continue(),)),)}, "the branch never comes to its gate"),
        ({"swapped": None}, "has other branches"),
    ],
)
def test_a_spoilt_branch_is_refused(changes: dict[str, Any], message: str) -> None:
    """A branch is a function: it has a name of its own and ends by itself."""
    with pytest.raises(BadPlan, match=message):
        verify(spoilt_join(**changes))


def test_a_join_where_the_graph_has_no_fork_is_refused() -> None:
    """The branches would fly what the source does not say."""
    join = next(step for step in FORKED.body if isinstance(step, Join))
    with pytest.raises(BadPlan, match="no such fork at a"):
        verify(Plan(checked=GRAPH, body=(call("create"), call("a"), join, End())))


def test_a_branch_that_does_something_needs_a_clone() -> None:
    """Else its blocks would not be called."""
    first, join, *rest = FORKED.body
    assert isinstance(join, Join)
    left, right = join.branches
    spoilt = replace(join, branches=(replace(left, idle=True), right))
    with pytest.raises(BadPlan, match="no clone goes into branch _left"):
        verify(replace(FORKED, body=(first, spoilt, *rest)))


def test_a_wait_that_forgets_a_limit_is_refused() -> None:
    """It stands for every block that watches, and for no other."""
    plan = after("watch", GRAPHS["alfalfa"])
    wait = next(step for step in steps(plan.body) if isinstance(step, Watch))
    spoilt = replace(wait, watchers=wait.watchers[:1])
    body = rewritten_body(plan.body, lambda step, _: (spoilt if step is wait else step,))
    with pytest.raises(BadPlan, match="does not stand for all"):
        verify(replace(plan, body=body))


def test_a_branch_that_nobody_waits_for_is_refused() -> None:
    """Of branches that only wait the first stands for those behind it, and for no others."""
    text = GRAPHS["alfalfa"].replace("[watch, timer]", "[watch, timer, note]")
    plan = after("watch", f"{text}\nnote = MissionModifier emits STANDBY, COMPLETED, FAILED")
    join = next(step for step in steps(plan.body) if isinstance(step, Join))
    verify(plan)
    first, second, third = join.branches
    spoilt = (
        (first, replace(second, idle=False), third),
        (replace(first, idle=True), replace(second, idle=False), third),
        (replace(first, body=FORKED.body), second, third),
    )
    for ways in spoilt:
        wrong = partial(_put, join, replace(join, branches=ways))
        with pytest.raises(BadPlan, match=r"no clone goes into|does not stand for all"):
            verify(rewritten(plan, wrong))


def _put(old: Step, new: Step, step: Step, _: Step) -> Body:
    return (new if step is old else step,)


def spoilt_cases(*cases: Case, start: str = "create") -> Plan:
    (step,) = FREE.body
    assert isinstance(step, Dispatch)
    kept = tuple(case for case in step.cases if case.label not in {c.label for c in cases[:1]})
    return replace(FREE, body=(Dispatch(start=start, cases=(*kept, *cases)),))


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        (spoilt_cases(start="nowhere"), "no case nowhere"),
        (spoilt_cases(Case(label="b", body=(Goto(label="x"),))), "no case x"),
        (spoilt_cases(Case(label="b", body=())), "case b: a way comes to its end"),
        (spoilt_cases(*2 * [Case(label="b", body=(End(),))]), "two cases are called b"),
        (spoilt_cases(Case(label="z", body=(End(),))), "nothing ever comes to case z"),
        (
            spoilt_cases(Case(label="b", body=(Loop(head="b", body=(Continue(),)),))),
            "a loop inside a case",
        ),
    ],
)
def test_a_spoilt_dispatch_is_refused(plan: Plan, message: str) -> None:
    """Every label has a case, and every case is come to."""
    with pytest.raises(BadPlan, match=message):
        verify(plan)
