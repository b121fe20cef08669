"""Edges: what brackets mean, and what an edge takes."""

from __future__ import annotations

from plutoc.block import IN_GRAPH
from plutoc_runtime.domain.status import Status
from tests.compiler.graph.fakes import graph

ABCD = "a = Pass\nb = Pass\nc = Pass\nd = Pass\nw = Work\n"
C, F, S, U = Status.COMPLETED, Status.FAILED, Status.STANDBY, Status.UNEXECUTED


def test_brackets_are_all_pairs() -> None:
    """In the order of the source."""
    edges = graph(ABCD + "start -> [a, b] -> [c, d] -> end").edges
    assert [(e.source, e.target) for e in edges] == [
        ("start", "a"),
        ("start", "b"),
        ("a", "c"),
        ("a", "d"),
        ("b", "c"),
        ("b", "d"),
        ("c", "end"),
        ("d", "end"),
    ]


def test_two_statements_say_the_same() -> None:
    """As brackets do."""
    one = graph(ABCD + "a -> [b, c] -> d").edges
    two = graph(ABCD + "a -> b -> d\na -> c -> d").edges
    assert {(e.source, e.target, e.takes) for e in one} == {
        (e.source, e.target, e.takes) for e in two
    }


def test_guard_belongs_to_the_last_arrow() -> None:
    """And to every edge of it."""
    edges = graph(ABCD + "a -> b -> [c, d] when STANDBY, FAILED").edges
    assert [e.guard for e in edges] == [None, (S, F), (S, F)]
    assert [e.takes for e in edges] == [frozenset(IN_GRAPH), {S, F}, {S, F}]


def test_unguarded_edge_takes_what_its_target_accepts() -> None:
    """What needs a guard is not taken without one."""
    assert graph(ABCD + "a -> w").edges[0].takes == {U}
    assert graph(ABCD + "a -> w when FAILED").edges[0].takes == {F}


def test_otherwise_takes_the_rest() -> None:
    """What the target accepts, less what the block's other edges take."""
    edges = graph(ABCD + "a -> b when STANDBY\na -> c otherwise\nb -> c when FAILED").edges
    assert edges[1].takes == frozenset(IN_GRAPH) - {S}


def test_unguarded_edge_to_end_is_otherwise() -> None:
    """It takes COMPLETED and FAILED, as far as no other edge does."""
    one, two = graph(ABCD + "a -> b when COMPLETED\na -> end").edges
    assert (one.takes, two.takes) == (frozenset({C}), frozenset({F}))
    assert two.otherwise and two.guard is None


def test_spans_point_at_names_and_guards() -> None:
    """An edge is its two names and what is between them."""
    app = graph(ABCD + "a -> [b, c] when FAILED")
    one, two = app.edges
    quote = app.source.quote
    assert (quote(one.span), quote(two.span)) == ("a -> [b", "a -> [b, c")
    assert one.guard_span and quote(one.guard_span) == "when FAILED"
