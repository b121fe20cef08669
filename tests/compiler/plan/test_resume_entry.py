"""A plan can be entered where interrupted missions go on, wherever that is in a graph."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.check.model import Checked
from plutoc.diagnostic import Rejected
from plutoc.graph.model import START
from plutoc.plan.chart import Charts, Kind
from plutoc.plan.show import show
from tests.compiler.check import graphs
from tests.compiler.plan.graphs import GRAPHS, random_graphs
from tests.compiler.plan.test_walks import compare


def entered_anywhere(checked: Checked, luck: Random, most: int) -> Checked:
    """Return the graph as if missions went on at some of its blocks, with all that comes there."""
    (first,) = checked.graph.outgoing[START]
    chart = Charts(checked).chart(first.target, checked.carries[first])
    blocks = [spot for spot in chart.arrives if spot.kind is Kind.BLOCK and spot != chart.entry]
    chosen = luck.sample(blocks, min(len(blocks), luck.randint(1, most)))
    return replace(checked, entries={spot.name: chart.arrives[spot] for spot in chosen})


def test_missions_can_go_on_at_any_blocks_of_any_graph() -> None:
    """From there they do what the graph says, plain or optimised; and all kinds of entry turn up."""
    seen: Counter[str] = Counter()

    @settings(max_examples=400, deadline=None, derandomize=True, database=None)
    @given(text=random_graphs(), seed=st.integers(0, 1000))
    def each(text: str, seed: int) -> None:
        try:
            checked = entered_anywhere(graphs.checked(text), Random(seed), 5)
        except Rejected:
            return
        shown = show(compare(checked, range(seed, seed + 4)))
        seen.update(word for word in ("enter", "arrived", "dispatch", "loop") if word in shown)
        seen["copy"] += "arrived" not in shown and "loop" in shown and "dispatch" not in shown

    each()
    assert all(seen[word] > 2 for word in ("enter", "arrived", "dispatch", "copy")), seen


def test_missions_can_go_on_at_any_blocks_of_known_graphs() -> None:
    for number, text in enumerate(GRAPHS.values()):
        for seed in range(6):
            checked = graphs.checked(text)
            compare(entered_anywhere(checked, Random(f"{number} {seed}"), 4), range(8))
