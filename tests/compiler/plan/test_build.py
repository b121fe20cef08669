"""What a plan holds besides its shape."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from collections.abc import Iterator

import pytest

from plutoc import registry
from plutoc.check.run import check
from plutoc.graph.resolve import resolve
from plutoc.plan.build import build
from plutoc.plan.model import Body, Join, Loop, Step, Switch
from plutoc.plan.optimise import optimised
from plutoc.plan.show import show
from plutoc.plan.verify import verify
from plutoc.source import Source
from plutoc.syntax.parse import parse
from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import BASIC, checked
from tests.compiler.plan.graphs import GRAPHS, routes
from tests.compiler.plan.plans import structured
from tests.paths import CASES, ROOT


def steps(body: Body) -> Iterator[Step]:
    """All steps, those of branches included."""
    for step in body:
        yield step
        match step:
            case Join():
                for branch in step.branches:
                    yield from steps(branch.body)
            case Switch():
                for arm in step.arms:
                    yield from steps(arm.body)
            case Loop():
                yield from steps(step.body)
            case _:
                pass


def test_the_sample_compiles_from_its_source_to_the_same_plan() -> None:
    """Parsed, resolved and checked, it gives what its graph made by hand gives."""
    text = (CASES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")
    graph, _ = resolve(parse(Source("app.pluto", text)), registry.blocks())
    plan = show(build(check(graph)[0]))
    assert plan.splitlines()[0] == "plan alfalfa"
    assert plan.splitlines()[1:] == show(build(checked(GRAPHS["alfalfa"]))).splitlines()[1:]


def test_statuses_that_cannot_occur_do_not_appear() -> None:
    """The retry has no bound, so FAILED never leaves it: there is nothing to decide."""
    text = f"""{BASIC}
    retry = PriorityManager(max_attempts: 0)
    start -> create -> allocate -> launch -> watch
    watch -> retry when FAILED
    watch -> allocate when STANDBY
    watch -> end
    retry -> allocate when STANDBY"""
    switches = [s for s in steps(structured(text).body) if isinstance(s, Switch)]
    assert [[arm.to for arm in switch.arms] for switch in switches] == [
        ["allocate", "end", "retry"]
    ]


def test_a_block_in_a_branch_gets_only_the_statuses_of_that_branch() -> None:
    """Outside, the same block leads on by another edge; the branch knows nothing of it."""
    body = structured(GRAPHS["a block in a branch and outside"]).body
    (join,) = [step for step in body if isinstance(step, Join)]
    assert not any(isinstance(s, Switch) for b in join.branches for s in steps(b.body))


def test_an_end_that_nobody_wrote_is_an_end() -> None:
    """FAILED has no edge: the mission ends with it."""
    text = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end when COMPLETED"""
    (switch,) = [s for s in steps(structured(text).body) if isinstance(s, Switch)]
    assert [(arm.statuses, arm.to) for arm in switch.arms] == [
        ((Status.COMPLETED, Status.FAILED), "end"),
        ((Status.STANDBY,), "allocate"),
    ]


@pytest.mark.parametrize("name", GRAPHS)
def test_names_of_branches_are_free(name: str) -> None:
    """No two are the same, and none is a block's name or a word of Python's."""
    plan = build(checked(GRAPHS[name]))
    joins = [step for step in steps(plan.body) if isinstance(step, Join)]
    names = [branch.name for join in joins for branch in join.branches]
    assert len(set(names)) == len(names)
    for each in names:
        assert each.startswith("_") and not each.startswith("__")
        ast.parse(f"def {each}(): pass")


def test_a_branch_whose_name_is_taken_gets_the_next_free_number() -> None:
    """A block called `note_2` may have taken the name that a second `note` would get."""
    text = """
    create = MissionCreator
    note = MissionModifier
    note_2 = MissionModifier
    one = GateFunnel
    two = GateFunnel
    done = MissionModifier emits COMPLETED
    start -> create -> [note, note_2] when UNEXECUTED
    [note, note_2] -> one when UNEXECUTED
    one -> turn -> [note, note_2] when STANDBY
    turn = MissionModifier emits STANDBY
    [note, note_2] -> two when STANDBY
    two -> done -> end"""
    joins = [step for step in build(checked(text)).body if isinstance(step, Join)]
    assert [[branch.name for branch in join.branches] for join in joins] == [
        ["_note", "_note_2"],
        ["_note_3", "_note_2_2"],
    ]


def test_arms_that_leave_come_before_the_one_that_goes_on() -> None:
    """At once, then later; otherwise in the order of the source."""
    text = routes(
        a="STANDBY > b, COMPLETED > c, FAILED > end",
        b="STANDBY > a",
        c="STANDBY > d",
        d="STANDBY > a, COMPLETED > end",
    )
    switches = [s for s in steps(structured(text).body) if isinstance(s, Switch)]
    assert [arm.to for arm in switches[0].arms] == ["end", "b", "c"]


def test_plans_do_not_depend_on_the_hashes_of_a_run() -> None:
    """The same text under two seeds of Python's hash."""
    code = (
        "from tests.compiler.plan.graphs import GRAPHS\n"
        "from tests.compiler.check.graphs import checked\n"
        "from plutoc.plan.build import build\n"
        "from plutoc.plan.show import show\n"
        "for text in GRAPHS.values(): print(show(build(checked(text))))\n"
    )
    path = os.pathsep.join(str(ROOT / p) for p in (".", "grammar", "runtime", "stdlib_blocks"))
    runs = [
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": seed},
            check=True,
            capture_output=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert runs[0] == runs[1]
    assert b"join" in runs[0]


@pytest.mark.parametrize("arrow", ["", "    retry -> allocate otherwise\n"])
def test_a_block_that_nothing_leaves_is_the_end(arrow: str) -> None:
    """An evaluator's FAILED leaves no trip: the mission ends in the retry behind it."""
    text = f"""{BASIC}
    judge = MissionEvaluator
    retry = PriorityManager
    start -> create -> allocate -> launch -> watch
    [watch, judge] -> allocate when STANDBY
    watch -> end when FAILED
    watch -> judge when COMPLETED
    judge -> end when COMPLETED
    judge -> retry when FAILED
{arrow}"""
    for plan in (build(checked(text)), optimised(build(checked(text)))):
        verify(plan)
        assert "\n  call retry\n  end" in show(plan)
