"""A mission does in its plan what it does in its graph."""

from __future__ import annotations

from collections import Counter
from functools import partial
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.diagnostic import Rejected
from plutoc.plan.build import build
from plutoc.plan.model import Plan
from plutoc.plan.optimise import stages
from plutoc.plan.show import show
from plutoc.plan.verify import verify
from tests.compiler.check import graphs
from tests.compiler.check.walks import along_graph, edited, kept
from tests.compiler.plan.graphs import GRAPHS, random_graphs
from tests.compiler.plan.walks import entered_anywhere, goes_on, through_plan

WORDS = ("call", "loop", "break", "join", "goto", "enter", "arrived", "dispatch")
"""What a plan can hold."""


def compare(checked: Checked, seeds: range) -> Plan:
    """Walk the graph, the plan as it is built, and the plan after all passes."""
    plans = [plan for _, plan in stages(build(checked))]
    for plan in plans:
        verify(plan)
    for seed in seeds:
        wanted = kept(lambda diary: along_graph(checked, diary), seed)
        for plan in (plans[0], plans[-1]):
            assert kept(partial(through_plan, plan), seed) == wanted
        for place, status in goes_on(checked):
            wanted = kept(partial(along_graph, checked, place=place, status=status), seed)
            for plan in (plans[0], plans[-1]):
                through = partial(through_plan, plan, place=place, status=status)
                assert kept(through, seed) == wanted
    return plans[-1]


@pytest.mark.parametrize("name", GRAPHS)
def test_a_plan_visits_the_blocks_that_the_graph_does(name: str) -> None:
    """The same blocks, branches and gates, in the same order, with the same statuses."""
    checked = graphs.checked(GRAPHS[name])
    compare(checked, range(15))
    compare(entered_anywhere(checked, Random(name), 4), range(5))


def test_plans_of_random_graphs_do_what_the_graphs_do() -> None:
    """Blocks that route and fork wherever they like, entered anywhere; all that a plan holds turned up."""
    seen: Counter[str] = Counter()

    @settings(max_examples=120, deadline=None, derandomize=True, database=None)
    @given(text=random_graphs(), seed=st.integers(0, 1000))
    def each(text: str, seed: int) -> None:
        try:
            checked = graphs.checked(text)
        except Rejected:
            return
        plans = (
            compare(checked, range(seed, seed + 3)),
            compare(entered_anywhere(checked, Random(seed), 5), range(seed, seed + 2)),
        )
        shown = "".join(map(show, plans))
        seen.update(word for word in WORDS if word in shown)

    each()
    assert all(seen[word] for word in WORDS), seen


@settings(max_examples=30, deadline=None)
@given(text=edited(), seed=st.integers(0, 1000))
def test_plans_of_edited_graphs_do_what_the_graphs_do(text: str, seed: int) -> None:
    """A sound graph with a line bent: if it passes the checks, its plan is right."""
    try:
        checked, _ = check(graphs.build(text))
    except Rejected:
        return
    compare(checked, range(seed, seed + 6))
