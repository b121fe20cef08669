"""Loops with several entries get one each, at the price of a few copies."""

from __future__ import annotations

from random import Random

from plutoc.diagnostic import Rejected
from plutoc.graph.model import START
from plutoc.plan.chart import Charts, Kind, Spot
from plutoc.plan.irreducible import MOST_COPIES, reducible
from plutoc.plan.shape import Shape, shape
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import STATUSES, routes


def shape_of(text: str) -> Shape:
    """Return the shape of a graph's flow outside of all forks."""
    graph = checked(text)
    edge = next(edge for edge in graph.graph.outgoing[START])
    return shape(Charts(graph).chart(edge.target, graph.carries[edge]))


def copies(found: Shape) -> list[str]:
    return [spot.name for spot in found.order if spot.copy]


def test_a_loop_with_one_entry_stays_as_it_is() -> None:
    """The very same shape."""
    found = shape_of(routes(a="STANDBY > b, FAILED > end", b="STANDBY > a"))
    assert reducible(found) is found


def test_copies_are_few_and_lead_where_their_originals_do() -> None:
    """Every loop has one entry then, no fork is copied, and nothing else leads elsewhere."""
    tangled = 0
    for seed in range(120):
        try:
            before = shape_of(drawn(Random(seed)))
        except Rejected:
            continue
        after = reducible(before)
        if after is None:
            continue
        tangled += bool(before.entering)
        assert not after.entering
        assert len(copies(after)) <= MOST_COPIES
        for spot in after.order:
            assert not (spot.copy and spot.kind is Kind.FORK)
            assert targets(after, spot) == targets(before, spot.original)
    assert tangled > 5


def drawn(luck: Random) -> str:
    """Return a graph of blocks that lead anywhere."""
    names = [f"m{number}" for number in range(luck.randint(3, 8))]
    ways = {}
    for name in names:
        led = [f"{status} > {luck.choice(names)}" for status in STATUSES[: luck.randint(1, 2)]]
        ways[name] = ", ".join([*led, f"FAILED > {luck.choice([*names, 'end'])}"])
    return routes(**ways)


def targets(found: Shape, spot: Spot) -> list[tuple[object, ...]]:
    return [(way.statuses, way.target and way.target.original) for way in found.chart.ways[spot]]
