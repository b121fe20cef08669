"""Where things stand: the closest to a point is found without a look at each of many.

A few are looked at one by one. More are kept in squares, two or so in each, and only the squares
around the point are looked at; a crowded square has squares of its own. Heights count in the
distance, not in the squares. The answer is, to the last digit, that of a look at every thing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from heapq import heapify, heappop
from math import dist, hypot, inf, sqrt
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

from .strips import GRAIN, Strips

if TYPE_CHECKING:
    from ..model import Point

FEW = 96
"""So many are looked at one by one: it takes as long as to look around in squares."""

_IN_A_SQUARE = 2.0
_SAME = 1e-9
"""Metres: things that stand no farther apart than this need no squares."""


class Placed(Protocol):
    """What stands somewhere, and in which order it comes among its like."""

    @property
    def index(self) -> int:
        """Its place in that order."""
        ...


T = TypeVar("T", bound=Placed)


class Places(Generic[T]):
    """Things and where they stand."""

    __slots__ = ("_few", "_grid", "_least", "_most", "_places")

    def __init__(self, few: int = FEW) -> None:
        self._places: dict[T, Point] = {}
        self._grid: _Grid[T] | None = None
        self._few = few
        """More than these are kept in squares."""
        self._least, self._most = 0, few
        """While so many are here, the squares stay as they are."""

    def __len__(self) -> int:
        """Return how many are here."""
        return len(self._places)

    def __iter__(self) -> Iterator[T]:
        """Give all that are here."""
        return iter(self._places)

    def add(self, thing: T, place: Point) -> None:
        """Put a thing where it stands; it is not here yet."""
        self._places[thing] = place
        if self._grid is not None:
            self._grid.square(place).add(thing, place)
        if len(self._places) > self._most:
            self._arrange()

    def remove(self, thing: T) -> None:
        """Take a thing away, if it is here."""
        place = self._places.pop(thing, None)
        if place is not None and self._grid is not None:
            self._grid.square(place).remove(thing)
        if len(self._places) < self._least:
            self._arrange()

    def closest(
        self, goal: Point, able: Callable[[T], bool], best: float = inf, found: T | None = None
    ) -> tuple[float, T | None]:
        """Return the closest thing that is able and its distance, or what is better than that.

        Of those that are equally far it is the first in their order.
        """
        if self._grid is not None:
            return self._grid.closest(goal, able, best, found)
        for thing, place in self._places.items():
            away = dist(place, goal)
            better = away < best or (
                away == best and found is not None and thing.index < found.index
            )
            if better and able(thing):
                best, found = away, thing
        return best, found

    def outward(self, goal: Point) -> Iterator[tuple[float, T]]:
        """Give all things and how far away each is, the closest first."""
        left, outer = len(self._places), -1.0
        near, width = (0.0, inf) if self._grid is None else self._grid.first_look(goal)
        while left:
            inner, outer = outer, near + width
            found = [(away, thing.index, thing) for away, thing in self.within(goal, inner, outer)]
            left -= len(found)
            width *= 2.0
            heapify(found)  # not sorted: often only the first few are wanted
            while found:
                away, _, thing = heappop(found)
                yield away, thing

    def within(self, goal: Point, inner: float, outer: float) -> Iterator[tuple[float, T]]:
        """Give what is farther away than the one and not farther than the other, in any order."""
        if self._grid is not None:
            yield from self._grid.within(goal, inner, outer)
            return
        for thing, place in self._places.items():
            away = dist(place, goal)
            if inner < away <= outer:
                yield away, thing

    def _arrange(self) -> None:
        """Make new squares, for as many as there are now."""
        count = len(self._places)
        self._least, self._most = count // 2, max(2 * count, self._few)
        self._grid = _grid(self._places, self._few) if count > self._few else None


def _grid(places: Mapping[T, Point], few: int) -> _Grid[T] | None:
    """Return squares for these; none where all stand in one place."""
    xs, ys, zs = zip(*places.values(), strict=True)
    wide, deep, share = max(xs) - min(xs), max(ys) - min(ys), _IN_A_SQUARE / len(places)
    if max(wide, deep) <= _SAME:
        return None
    side = max(sqrt(wide * deep * share), max(wide, deep) * share)
    grid: _Grid[T] = _Grid(Strips(xs, side), Strips(ys, side), Strips(zs, inf), side, few)
    for thing, place in places.items():
        grid.square(place).add(thing, place)
    return grid


class _Grid(Generic[T]):
    """Squares that hold things: columns and rows, and one layer."""

    __slots__ = ("_columns", "_few", "_layer", "_rows", "_side", "_squares")

    def __init__(self, columns: Strips, rows: Strips, layer: Strips, side: float, few: int) -> None:
        self._columns, self._rows, self._layer = columns, rows, layer
        self._side, self._few = side, few
        self._squares: list[Places[T] | None] = [None] * (columns.count * rows.count)

    def square(self, place: Point) -> Places[T]:
        """Return the square for what stands at a place."""
        x, y, z = place
        self._layer.hold(z)
        index = self._rows.hold(y) * self._columns.count + self._columns.hold(x)
        square = self._squares[index]
        if square is None:
            square = self._squares[index] = Places(self._few)
        return square

    def closest(
        self, goal: Point, able: Callable[[T], bool], best: float, found: T | None
    ) -> tuple[float, T | None]:
        """Look at rows outward from the goal, and at squares outward in each, while it may help."""
        x, y, z = goal
        above, nearest = self._layer.gap(z), self._columns.gap(x)
        for row, ahead in self._rows.outward(y):
            off = above * above + ahead * ahead
            reach = _reach(best, off)
            if reach < nearest:
                break
            first = row * self._columns.count
            for column, beside in self._columns.outward(x):
                if beside > reach:
                    break
                square = self._squares[first + column]
                if square is not None:
                    away, found = square.closest(goal, able, best, found)
                    if away < best:
                        best, reach = away, _reach(away, off)
        return best, found

    def within(self, goal: Point, inner: float, outer: float) -> Iterator[tuple[float, T]]:
        """Look into all squares that are near enough."""
        x, y, z = goal
        above, nearest = self._layer.gap(z), self._columns.gap(x)
        for row, ahead in self._rows.outward(y):
            reach = _reach(outer, above * above + ahead * ahead)
            if reach < nearest:
                break
            first = row * self._columns.count
            for column, beside in self._columns.outward(x):
                if beside > reach:
                    break
                square = self._squares[first + column]
                if square is not None:
                    yield from square.within(goal, inner, outer)

    def first_look(self, goal: Point) -> tuple[float, float]:
        """Return how far away all are at least, and how much farther some should be found."""
        x, y, z = goal
        return hypot(self._columns.gap(x), self._rows.gap(y), self._layer.gap(z)), self._side


def _reach(best: float, off: float) -> float:
    """Return how far to look sideways when it is so far already (squared); below 0: no more."""
    left = best * best * (1.0 + GRAIN) - off
    return sqrt(left) if left >= 0.0 else -1.0
