"""Each pass by examples: a graph, the plan before the pass, and the plan after it.

The cases of a pass stand in the file of its name beside this one. `pytest tests/compiler/plan --update`
writes the plans anew: read the difference before committing.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.plan.build import build
from plutoc.plan.model import Plan
from plutoc.plan.optimise import PASSES, optimised, stages
from plutoc.plan.show import show
from plutoc.plan.verify import verify
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS
from tests.compiler.plan.plans import begun
from tests.kit.sections import Section, compare, params

FILES = sorted(Path(__file__).parent.glob("*.txt"))


def _body(plan: Plan) -> str:
    return show(plan).partition("\n")[2].rstrip()


@pytest.mark.parametrize("case", params(*FILES))
def test_a_pass_makes_of_a_plan_what_its_case_says(case: Section, update: bool) -> None:
    """The plan before is the one that the passes before it leave."""
    plans = list(stages(build(begun(case.given))))
    number = [stage for stage, _ in plans].index(case.path.stem)
    before, after = (plan for _, plan in plans[number - 1 : number + 1])
    compare(case, f"-- before\n{_body(before)}\n-- after\n{_body(after)}", update)


def test_every_pass_has_cases_and_says_what_it_does() -> None:
    """A file of cases each; and its docstring shows a plan before and after."""
    assert {path.stem for path in FILES} == {each.__name__ for each in PASSES}
    for each in PASSES:
        module = __import__(each.__module__, fromlist=["__doc__"])
        assert module.__doc__ and "Before:" in module.__doc__ and "After:" in module.__doc__


@pytest.mark.parametrize("name", GRAPHS)
def test_what_was_optimised_stays_as_it_is(name: str) -> None:
    """Each pass leaves a sound plan, and a second time they find nothing more to do."""
    plans = [plan for _, plan in stages(build(checked(GRAPHS[name])))]
    for plan in plans:
        verify(plan)
    assert show(optimised(plans[-1])) == show(plans[-1])
