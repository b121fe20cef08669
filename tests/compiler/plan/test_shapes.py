"""Which plan a graph becomes: loops, branches and forks, and where interrupted missions come in.

For each case of `shapes.txt`: the structure before any step is changed, as if no mission was ever interrupted, and
the whole plan after all passes.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.plan.build import build
from plutoc.plan.optimise import optimised
from plutoc.plan.show import show
from tests.compiler.check.graphs import checked
from tests.compiler.plan.plans import CHAIN, structured
from tests.kit.sections import Section, compare, params


@pytest.mark.parametrize("case", params(Path(__file__).with_name("shapes.txt")))
def test_a_graph_becomes_this_plan(case: Section, update: bool) -> None:
    plans = {
        "structured": structured(case.given),
        "optimised": optimised(build(checked(case.given))),
    }
    shown = [f"-- {name}\n{show(plan).partition(chr(10))[2]}" for name, plan in plans.items()]
    compare(case, "".join(shown), update)


def test_without_structure_missions_go_on_at_a_case() -> None:
    plan = show(optimised(build(checked(CHAIN))))
    first, *rest = plan.partition("\n")[2].partition("left out:")[0].strip().splitlines()
    assert first.startswith("dispatch from create, allocate, wait0, wait1, ")
    assert [line.strip() for line in rest if line.startswith("    case wait")] == [
        f"case wait{n}" for n in range(50)
    ]
