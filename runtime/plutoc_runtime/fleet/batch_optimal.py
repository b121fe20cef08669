"""`batch_optimal`: all waiting trips and all free drones at once, least total distance.

Row after row gets a column by the cheapest way on which others change theirs: successive shortest
paths, with prices that keep every cost at or above 0 (Edmonds and Karp 1972). A row tells its
columns one by one, the cheapest first, and no more of them than matter (U, Mamoulis and Yiu 2008):
where few want the same, that is next to nothing.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from heapq import heappop, heappush
from itertools import chain
from math import inf
from typing import TYPE_CHECKING, Generic, TypeVar

from .batch import Batch

if TYPE_CHECKING:
    from ..domain.model import Drone
    from .policies import Choice
    from .queue import Request

C = TypeVar("C")
Row = int
Column = int

_NONE = -1
_WITHOUT = 1e8  # what it costs a row to go without a column: more than all others together


@Batch
def batch_optimal(
    requests: Sequence[Request], free: Sequence[Drone], _: object
) -> Sequence[Choice | None]:
    """Give as many trips a drone as can be, so that the way of all together is shortest."""
    goals = [request.goal for request in requests]

    def drones_for(number: int) -> Iterator[tuple[float, int]]:
        away = sorted((drone.distance(goals[number]), place) for place, drone in enumerate(free))
        return (pair for pair in away if requests[number].able(free[pair[1]]))

    def trips_for(place: int) -> Iterator[tuple[float, int]]:
        away = sorted((free[place].distance(goal), number) for number, goal in enumerate(goals))
        return (pair for pair in away if requests[pair[1]].able(free[place]))

    pairs: list[tuple[float, int] | None] = [None] * len(requests)
    if len(requests) <= len(free):  # the fewer choose among the more: so it is quick
        pairs = assign([drones_for(number) for number in range(len(requests))])
    else:
        for place, pair in enumerate(assign([trips_for(place) for place in range(len(free))])):
            if pair is not None:
                pairs[pair[1]] = (pair[0], place)
    why = f"least total way for {len(requests)} waiting trips and {len(free)} free drones"
    return [pair and (free[pair[1]], f"{why}: {pair[0]:.1f} m away") for pair in pairs]


def assign(rows: Sequence[Iterator[tuple[float, C]]]) -> list[tuple[float, C] | None]:
    """Return a column and its cost for each row; None for a row that goes without.

    As many rows as can be have a column, and the sum of costs is least. Each row gives the columns that it may
    have, with their costs, the cheapest first. It is quick where there are no more rows than columns.
    """
    pairs = _Pairs(rows)
    for row in range(len(rows)):
        pairs.add(row)
    return [pairs.of(row) for row in range(len(rows))]


class _Pairs(Generic[C]):
    """The pairs so far: no others, as many, cost less.

    The price of a row and that of a column are together at most the cost of their pair, and equal to
    it if the pair is made. A free column costs 0, and none costs more. Each row has a column of its
    own, its last, that stands for going without.
    """

    def __init__(self, rows: Sequence[Iterator[tuple[float, C]]]) -> None:
        self._more = [chain(row, [(_WITHOUT, None)]) for row in rows]
        self._told = [array("l") for _ in rows]  # the columns that each row has told so far
        self._costs = [array("d") for _ in rows]
        """Numbers side by side: millions of them are read again and again."""
        self._taken = [0] * len(rows)  # how many of these, the first, are taken
        self._row_price = [0.0] * len(rows)
        self._column_of = [_NONE] * len(rows)
        self._row_of: list[Row] = []
        self._column_price: list[float] = []
        self._numbers: dict[C, Column] = {}
        self._names: list[C | None] = []

    def of(self, row: Row) -> tuple[float, C] | None:
        """Return the column of a row, and what it costs."""
        place = self._told[row].index(self._column_of[row])
        name = self._names[self._column_of[row]]
        return None if name is None else (self._costs[row][place], name)

    def add(self, start: Row) -> None:
        """Give one more row a column, by the cheapest way outward from it (Dijkstra 1959)."""
        via: dict[Column, Row] = {}
        rows: list[tuple[Row, float]] = []
        columns: list[tuple[Column, float]] = []
        heap: list[tuple[float, Column]] = []
        best = [inf] * len(self._names)
        row = start
        away = 0.0
        bound = inf
        while True:
            rows.append((row, away))
            base = away - self._row_price[row]
            costs = self._costs[row]
            place = self._first_free(row)
            if base + costs[place] < bound:
                bound = base + costs[place]
                end = self._told[row][place]
                last = row
            nearer = bisect_left(costs, bound - base, 0, place)
            for cost, column in zip(costs[:nearer], self._told[row], strict=False):
                way = base + cost - self._column_price[column]
                if way < best[column]:
                    best[column] = way
                    via[column] = row
                    heappush(heap, (way, column))
            while heap and heap[0][0] != best[heap[0][1]]:
                heappop(heap)  # a cheaper way has been found since
            if not heap or heap[0][0] >= bound:
                break
            away, column = heappop(heap)
            best[column] = -inf
            columns.append((column, away))
            row = self._row_of[column]
        for row, away in rows:
            self._row_price[row] += bound - away
        for column, away in columns:
            self._column_price[column] -= bound - away
        row = last
        column = end
        while True:  # back along the way, each row takes the column that leads on
            before = self._column_of[row]
            self._column_of[row] = column
            self._row_of[column] = row
            if row == start:
                return
            column = before
            row = via[column]

    def _first_free(self, row: Row) -> int:
        """Return the place of the first free column among those that a row tells."""
        told = self._told[row]
        place = self._taken[row]
        while place == len(told) or self._row_of[told[place]] != _NONE:
            if place == len(told):
                cost, name = next(self._more[row])
                self._costs[row].append(cost)
                told.append(self._numbered(name))
            else:
                place += 1
        self._taken[row] = place
        return place

    def _numbered(self, name: C | None) -> Column:
        number = len(self._names)
        if name is not None:
            number = self._numbers.setdefault(name, number)
        if number == len(self._names):
            self._names.append(name)
            self._row_of.append(_NONE)
            self._column_price.append(0.0)
        return number
