"""Which plan a graph becomes: loops, branches and forks, and where interrupted missions come in.

For each case of `shapes.txt`, and of `spent.txt`, where no trip is left to fly: the structure before any step is
changed, as if no mission was ever interrupted, and the whole plan after all passes.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from plutoc import registry
from plutoc.check.run import check
from plutoc.graph.resolve import resolve
from plutoc.plan.bodies import steps
from plutoc.plan.build import build
from plutoc.plan.model import Join, Plan
from plutoc.plan.optimise import optimised
from plutoc.plan.show import show
from plutoc.source import Source
from plutoc.syntax.parse import parse
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS
from tests.compiler.plan.plans import CHAIN, structured
from tests.kit.sections import Section, compare, params
from tests.paths import CASES


@pytest.mark.parametrize("case", params(*sorted(Path(__file__).parent.glob("*.txt"))))
def test_a_graph_becomes_this_plan(case: Section, update: bool) -> None:
    plans = {
        "structured": structured(case.given),
        "optimised": optimised(build(checked(case.given))),
    }
    shown = [f"-- {name}\n{show(plan).partition(chr(10))[2]}" for name, plan in plans.items()]
    compare(case, "".join(shown), update)


def test_the_sample_compiles_from_its_source_to_the_same_plan() -> None:
    """Parsed, resolved and checked, it gives what its graph made by hand gives."""
    text = (CASES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")
    graph, _ = resolve(parse(Source("app.pluto", text)), registry.blocks())
    plan = show(build(check(graph)[0]))
    assert plan.splitlines()[0] == "plan alfalfa"
    assert plan.splitlines()[1:] == show(build(checked(GRAPHS["alfalfa"]))).splitlines()[1:]


def joins(plan: Plan) -> Iterator[Join]:
    return (step for step in steps(plan.body) if isinstance(step, Join))


@pytest.mark.parametrize("name", GRAPHS)
def test_names_of_branches_are_free(name: str) -> None:
    """No two are the same, and none is a block's name or a word of Python's."""
    names = [
        branch.name for join in joins(build(checked(GRAPHS[name]))) for branch in join.branches
    ]
    assert len(set(names)) == len(names)
    for each in names:
        assert each.startswith("_") and not each.startswith("__")
        ast.parse(f"def {each}(): pass")


def test_without_structure_missions_go_on_at_a_case() -> None:
    plan = show(optimised(build(checked(CHAIN))))
    first, *rest = plan.partition("\n")[2].partition("left out:")[0].strip().splitlines()
    assert first.startswith("dispatch from create, allocate, wait0, wait1, ")
    assert [line.strip() for line in rest if line.startswith("    case wait")] == [
        f"case wait{n}" for n in range(50)
    ]
