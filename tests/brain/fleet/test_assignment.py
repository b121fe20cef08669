"""As many pairs as there can be, and among those the cheapest."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import permutations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.fleet.batch_optimal import assign

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


@settings(max_examples=100)
@given(table(4))
@example([[1.0, None], [2.0, None], [0.0, None]])
@example([[5.0, 1.0], [1.0, None]])
@example([[None, None]])
def test_it_is_the_best_of_all_ways(costs: list[list[float | None]]) -> None:
    """Where a row has to go without it is the one that is best left."""
    assert worth(solved(costs)) == best(costs)


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
