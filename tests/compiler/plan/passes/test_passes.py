"""Each pass by examples: a graph, the plan before the pass, and the plan after it.

The cases of a pass stand in the file of its name beside this one. `pytest tests/compiler/plan --update`
writes the plans anew: read the difference before committing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
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

FOLDER = Path(__file__).parent
TITLE = re.compile(r"^== (.+)$", re.MULTILINE)
PLANS = re.compile(r"^-- (?:before|after)$", re.MULTILINE)


def cases() -> Iterator[tuple[str, str, str]]:
    """Yield each case: its pass, its title and its text."""
    for path in sorted(FOLDER.glob("*.txt")):
        _, *parts = TITLE.split(path.read_text(encoding="utf-8"))
        for title, text in zip(parts[::2], parts[1::2], strict=True):
            yield path.stem, title, text


def written(graph: str, name: str) -> str:
    """Return a case as it must be: the graph, and the plans around the pass."""
    plans = list(stages(build(begun(graph))))
    number = [stage for stage, _ in plans].index(name)
    before, after = (plan for _, plan in plans[number - 1 : number + 1])
    return f"\n{graph.strip()}\n-- before\n{_body(before)}\n-- after\n{_body(after)}\n"


def _body(plan: Plan) -> str:
    return show(plan).partition("\n")[2].rstrip()


CASES = tuple(cases())
TITLES = [f"{name}: {title}" for name, title, _ in CASES]


@pytest.mark.parametrize(("name", "title", "text"), CASES, ids=TITLES)
def test_a_pass_makes_of_a_plan_what_its_case_says(
    name: str, title: str, text: str, update: bool
) -> None:
    """The plan before is the one that the passes before it leave."""
    made = written(PLANS.split(text)[0], name)
    if update:
        path = FOLDER / f"{name}.txt"
        whole = path.read_text(encoding="utf-8")
        path.write_text(whole.replace(f"== {title}{text}", f"== {title}{made}\n"), encoding="utf-8")
        text = made
    assert made.strip() == text.strip()


def test_every_pass_has_cases_and_says_what_it_does() -> None:
    """A file of cases each; and its docstring shows a plan before and after."""
    assert {name for name, _, _ in CASES} == {each.__name__ for each in PASSES}
    for each in PASSES:
        module = __import__(each.__module__, fromlist=["__doc__"])
        assert module.__doc__ and "Before:" in module.__doc__ and "After:" in module.__doc__


@pytest.mark.parametrize("name", GRAPHS)
def test_after_each_pass_a_plan_is_still_sound(name: str) -> None:
    """A mission goes on where the graph says, and nothing is left out."""
    for _, plan in stages(build(checked(GRAPHS[name]))):
        verify(plan)


@pytest.mark.parametrize("name", GRAPHS)
def test_what_was_optimised_stays_as_it_is(name: str) -> None:
    """A second time the passes find nothing more to do."""
    plan = optimised(build(checked(GRAPHS[name])))
    assert show(optimised(plan)) == show(plan)
