"""As many pairs as there can be, and among those the cheapest."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations
from random import Random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.fleet.assignment import assign

Costs = Sequence[Sequence[float | None]]
"""A row each; None: that pair may not be."""
Pairs = list[tuple[float, int] | None]


def told(row: Sequence[float | None]) -> Iterator[tuple[float, int]]:
    """Tell the columns that a row may have, the cheapest first."""
    return iter(sorted((cost, column) for column, cost in enumerate(row) if cost is not None))


def solved(costs: Costs) -> Pairs:
    """Assign, and look whether the answer fits the question."""
    pairs = assign([told(row) for row in costs])
    columns = [pair[1] for pair in pairs if pair is not None]
    assert len(set(columns)) == len(columns)
    for row, pair in zip(costs, pairs, strict=True):
        assert pair is None or row[pair[1]] == pair[0]
    return pairs


def worth(pairs: Pairs) -> tuple[int, float]:
    """Return how many go without, and what the others cost."""
    return pairs.count(None), sum(pair[0] for pair in pairs if pair is not None)


def best(costs: Costs) -> tuple[int, float]:
    """Try every way."""
    rows, columns = len(costs), len(costs[0])
    ways = permutations([*range(columns), *[None] * rows], rows)

    def cost(row: int, column: int | None) -> float | None:
        return None if column is None else costs[row][column]

    taken = ([cost(row, column) for row, column in enumerate(way)] for way in ways)
    return min(
        (way.count(None), sum(c for c in way if c is not None)) for way in set(map(tuple, taken))
    )


def table(most: int) -> st.SearchStrategy[list[list[float | None]]]:
    """Return tables with many equal costs, and many pairs that may not be."""
    cell = st.one_of(st.none(), st.integers(0, 6).map(float), st.integers(0, 50).map(float))
    return st.tuples(st.integers(1, most), st.integers(1, most)).flatmap(
        lambda size: st.lists(
            st.lists(cell, min_size=size[0], max_size=size[0]), min_size=size[1], max_size=size[1]
        )
    )


@settings(max_examples=250)
@given(table(4))
@example([[1.0, None], [2.0, None], [0.0, None]])
@example([[5.0, 1.0], [1.0, None]])
@example([[None, None]])
def test_it_is_the_best_of_all_ways(costs: list[list[float | None]]) -> None:
    """Where a row has to go without it is the one that is best left."""
    assert worth(solved(costs)) == best(costs)


Edge = tuple[int, int, float]
"""A row takes what another has; what that costs more than what the row had."""


def exchanges(costs: Costs, pairs: Pairs) -> list[Edge]:
    """Return all that one row can take. One number past the rows stands for the free columns."""
    free = len(costs)
    owner = {pair[1]: row for row, pair in enumerate(pairs) if pair is not None}
    without = [row for row, pair in enumerate(pairs) if pair is None]
    edges = [(free, row, 0.0) for row in owner.values()]
    for row, pair in enumerate(pairs):
        had = 0.0 if pair is None else pair[0]
        edges += [
            (row, owner.get(column, free), cost - had)
            for column, cost in enumerate(costs[row])
            if cost is not None
        ]
        if pair is not None:
            edges += [(row, other, -had) for other in without]
    return edges


def reached(edges: Sequence[Edge], start: int) -> set[int]:
    seen, new = set[int](), {start}
    while new:
        seen |= new
        new = {edge[1] for edge in edges if edge[0] in new} - seen
    return seen


def can_be_cheaper(edges: Sequence[Edge], nodes: int) -> bool:
    """Return whether an exchange all around has a sum below 0 (Bellman and Ford)."""
    length = [0.0] * nodes
    for _ in range(nodes + 1):
        shorter = [(b, length[a] + c) for a, b, c in edges if length[a] + c < length[b] - 1e-6]
        if not shorter:
            return False
        for node, new in shorter:
            length[node] = min(length[node], new)
    return True


@pytest.mark.parametrize("seed", range(24))
def test_no_exchange_makes_it_better(seed: int) -> None:
    """Of tables that are too large to try every way: drones and trips in a field, and mere chance."""
    random = Random(seed)
    rows, columns = random.choice([(40, 40), (30, 50), (50, 30), (45, 44)])
    share = random.choice([1.0, 0.5, 0.1, 0.03])
    ways = [(random.uniform(0, 100), random.uniform(0, 100)) for _ in range(rows + columns)]
    costs = [
        [
            (
                (
                    abs(complex(*ways[row]) - complex(*ways[rows + column]))
                    if seed % 3
                    else 1.0 * (row ^ column)
                )
                if random.random() < share
                else None
            )
            for column in range(columns)
        ]
        for row in range(rows)
    ]
    pairs = solved(costs)
    edges = exchanges(costs, pairs)
    plain = [(a, b, c) for a, b, c in edges if a != rows and (pairs[b] if b < rows else True)]
    for row, pair in enumerate(pairs):
        if pair is None:
            assert rows not in reached(plain, row), "one more could have a column"
    assert not can_be_cheaper(edges, rows + 1)


def test_no_more_is_asked_of_a_row_than_matters() -> None:
    """Of 1,000 columns each row tells its first few."""
    asked = 0

    def counted(row: int) -> Iterator[tuple[float, int]]:
        nonlocal asked
        for step in range(1000):
            asked += 1
            yield float(step), (10 * row + step) % 1000

    assert worth(assign([counted(row) for row in range(100)])) == (0, 0.0)
    assert asked <= 200


def test_no_drones_and_no_requests() -> None:
    assert assign([]) == []
    assert assign([iter([]), iter([(3.0, "a")])]) == [None, (3.0, "a")]
