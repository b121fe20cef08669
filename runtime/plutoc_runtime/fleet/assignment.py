"""Pairs of rows and columns: as many as there can be, and among those the least sum of costs.

Row after row gets a column by the cheapest way on which others change theirs: successive shortest
paths, with prices that keep every cost at or above 0 (Edmonds and Karp 1972). A row tells its
columns one by one, the cheapest first, and no more of them than matter (U, Mamoulis and Yiu 2008):
where few want the same, that is next to nothing.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from math import inf
from typing import Generic, TypeVar

C = TypeVar("C")
Row = int
Column = int

_NONE = -1


def assign(rows: Sequence[Iterator[tuple[float, C]]]) -> list[tuple[float, C] | None]:
    """Return a column and its cost for each row; None for a row that goes without.

    Each row gives the columns that it may have, with their costs, the cheapest first. It is quick
    where there are no more rows than columns.
    """
    pairs = _Pairs(rows)
    for row in range(len(rows)):
        pairs.add(row)
    return [pairs.of(row) for row in range(len(rows))]


@dataclass(slots=True)
class _Search:
    """What a search for the cheapest way has found."""

    bound: float = inf
    """What the cheapest way costs."""
    end: tuple[Row, Column] = (_NONE, _NONE)
    """The last row of that way, and the column that it takes."""
    rows: list[tuple[Row, float]] = field(default_factory=list)
    """Those that were reached, and what it costs to get there."""
    columns: list[tuple[Column, float]] = field(default_factory=list)


Last = Callable[[Row, float], tuple[float, Column]]
"""Says what a way costs that ends with a row, and which column that row then takes."""


class _Pairs(Generic[C]):
    """The pairs so far: no others, as many, cost less.

    The price of a row and that of a column are together at most the cost of their pair, and equal to
    it if the pair is made. A free column costs 0, and none costs more.

    A row that must go without is thought to have a column of its own, dear beyond all measure.
    `_closed` are the columns from which no way leads to a free one; their prices, and those of the
    rows that have or want them, are told without that measure.
    """

    def __init__(self, more: Sequence[Iterator[tuple[float, C]]]) -> None:
        self._more = more
        self._told = [array("l") for _ in more]
        """The columns that each row has told so far."""
        self._costs = [array("d") for _ in more]
        """Numbers side by side: millions of them are read again and again."""
        self._taken = [0] * len(more)
        """How many of these, the first, are taken."""
        self._row_price = [0.0] * len(more)
        self._column_of = [_NONE] * len(more)
        self._row_of: list[Row] = []
        self._column_price: list[float] = []
        self._closed: list[Column] = []
        self._numbers: dict[C, Column] = {}
        self._names: list[C] = []

    def of(self, row: Row) -> tuple[float, C] | None:
        """Return the column of a row, and what it costs."""
        mine = self._column_of[row]
        if mine == _NONE:
            return None
        return self._costs[row][self._told[row].index(mine)], self._names[mine]

    def add(self, start: Row) -> None:
        """Give one more row a column, or let that one go without that is then the best to leave."""
        via: dict[Column, Row] = {}
        found = self._search([(start, 0.0)], via, self._closed, 0.0, self._take_free)
        columns = found.columns
        if found.end[1] == _NONE:
            shut = [column for column, _ in columns]
            dearest = max((self._column_price[column] for column in self._closed), default=0.0)
            found = self._search(found.rows, via, shut, dearest, self._go_without)
            columns = columns + found.columns
            self._closed += shut
        for row, away in found.rows:
            self._row_price[row] += found.bound - away
        for column, away in columns:
            self._column_price[column] -= found.bound - away
        row, column = found.end
        while True:
            before, self._column_of[row] = self._column_of[row], column
            if column != _NONE:
                self._row_of[column] = row
            if row == start:
                return
            row, column = via[before], before

    def _search(
        self,
        starts: Iterable[tuple[Row, float]],
        via: dict[Column, Row],
        shut: Iterable[Column],
        dearest: float,
        last: Last,
    ) -> _Search:
        """Go outward from rows over taken columns that are not shut (Dijkstra 1959)."""
        found, price, row_of = _Search(), self._column_price, self._row_of
        heap: list[tuple[float, Column]] = []
        best = [inf] * len(price)
        for column in shut:
            best[column] = -inf
        coming = list(starts)
        while True:
            for row, away in coming:
                found.rows.append((row, away))
                cost, column = last(row, away)
                if cost < found.bound:
                    found.bound, found.end = cost, (row, column)
                base, costs = away - self._row_price[row], self._costs[row]
                stop = bisect_left(costs, found.bound - base + dearest, 0, self._taken[row])
                nearer = [
                    (way, column)
                    for cost, column in zip(costs[:stop], self._told[row], strict=False)
                    if (way := base + cost - price[column]) < best[column]
                ]
                for way, column in nearer:
                    best[column], via[column] = way, row
                    heappush(heap, (way, column))
            while heap and heap[0][0] != best[heap[0][1]]:
                heappop(heap)  # a cheaper way has been found since
            if not heap or heap[0][0] >= found.bound:
                return found
            away, column = heappop(heap)
            best[column] = -inf
            found.columns.append((column, away))
            coming = [(row_of[column], away)]

    def _take_free(self, row: Row, away: float) -> tuple[float, Column]:
        """End a way with the cheapest free column."""
        told, row_of, taken = self._told[row], self._row_of, self._taken[row]
        while True:
            while taken < len(told) and row_of[told[taken]] != _NONE:
                taken += 1
            self._taken[row] = taken
            if taken < len(told):
                return away + self._costs[row][taken] - self._row_price[row], told[taken]
            more = next(self._more[row], None)
            if more is None:
                return inf, _NONE
            self._costs[row].append(more[0])
            told.append(self._numbered(more[1]))

    def _go_without(self, row: Row, away: float) -> tuple[float, Column]:
        """End a way with a row that has no column."""
        return away - self._row_price[row], _NONE

    def _numbered(self, name: C) -> Column:
        number = self._numbers.setdefault(name, len(self._names))
        if number == len(self._names):
            self._names.append(name)
            self._row_of.append(_NONE)
            self._column_price.append(0.0)
        return number
