"""What must be passed on the way to a place is found as networkx finds it."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from plutoc.plan.dominators import immediate_dominators


@st.composite
def charts(draw: st.DrawFn) -> list[list[int]]:
    """Draw the places that lead to each place; each has one that stands before it."""
    size = draw(st.integers(1, 12))
    earlier = [draw(st.integers(0, place - 1)) for place in range(1, size)]
    pairs = st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))
    more = draw(st.lists(pairs, max_size=2 * size))
    before: list[list[int]] = [[] for _ in range(size)]
    for two, one in enumerate(earlier, start=1):
        before[two].append(one)
    for one, two in more:
        before[two].append(one)
    return before


@given(charts())
def test_dominators_are_those_of_networkx(before: list[list[int]]) -> None:
    """At any number of loops, with one way in or several."""
    graph = nx.DiGraph((one, two) for two, ones in enumerate(before) for one in ones)
    graph.add_node(0)
    wanted = dict(nx.immediate_dominators(graph, 0))
    wanted[0] = 0  # some releases leave the first place out
    assert dict(enumerate(immediate_dominators(before))) == wanted
