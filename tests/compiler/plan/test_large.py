"""Large graphs: flat where they can be, never deeper than Python allows, never slow to find out."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from plutoc.plan.build import build
from plutoc.plan.show import show
from plutoc.plan.structure import MOST_NESTED_ARMS, MOST_NESTED_LOOPS
from plutoc.plan.verify import verify
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import routes

LAST = "FAILED > end"


def row(count: int) -> str:
    """Blocks in a row; from each a mission may end."""
    ways = {f"m{i}": f"STANDBY > m{i + 1}, FAILED > end" for i in range(count)}
    return routes(**ways, **{f"m{count}": LAST})


def diamonds(count: int) -> str:
    """Two ways that meet, again and again."""
    ways: dict[str, str] = {}
    for i in range(count):
        ways[f"m{i}"] = f"STANDBY > a{i}, FAILED > b{i}"
        ways[f"a{i}"] = ways[f"b{i}"] = f"STANDBY > m{i + 1}"
    return routes(**ways, **{f"m{count}": LAST})


def onion(count: int) -> str:
    """The way back to the end passes as many blocks as the way in: each a meeting."""
    ways = {f"m{i}": f"STANDBY > m{i + 1}, FAILED > x{i}" for i in range(count)}
    ways[f"m{count}"] = f"FAILED > x{count}"
    ways.update({f"x{i}": f"FAILED > x{i - 1}" for i in range(count, 0, -1)})
    return routes(**ways, x0=LAST)


def loops(count: int) -> str:
    """Loops in loops."""
    ways = {f"m{i}": f"STANDBY > m{i + 1}" for i in range(count)}
    ways[f"m{count}"] = f"STANDBY > k{count - 1}"
    ways.update({f"k{i}": f"STANDBY > m{i}, FAILED > k{i - 1}" for i in range(count - 1, 0, -1)})
    return routes(**ways, k0="STANDBY > m0, FAILED > end")


def depth(shown: str) -> int:
    return max(len(line) - len(line.lstrip()) for line in shown.splitlines()) // 2


@pytest.mark.parametrize("graph", [row, diamonds])
def test_a_long_graph_stays_flat(graph: Callable[[int], str]) -> None:
    """What goes on stands behind what leaves, not inside it."""
    plan = build(checked(graph(100)))
    verify(plan)
    assert "dispatch" not in show(plan)
    assert depth(show(plan)) <= 5


@pytest.mark.parametrize(("graph", "most"), [(onion, MOST_NESTED_ARMS), (loops, MOST_NESTED_LOOPS)])
def test_a_deep_graph_becomes_a_dispatch_before_it_is_too_deep(
    graph: Callable[[int], str], most: int
) -> None:
    """Python refuses a hundred indentations, and twenty loops in each other."""
    deepest, deeper, deep = (build(checked(graph(count))) for count in (most, most + 1, 120))
    for plan in (deepest, deeper, deep):
        verify(plan)
    assert "dispatch" not in show(deepest)
    assert "dispatch" in show(deeper)
    assert depth(show(deep)) <= 5
