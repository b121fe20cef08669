"""Where drones stand: the closest to a point is found without a look at each of many.

A few are looked at one by one. More are kept in squares, two or so in each, and only the squares
around the point are looked at; a crowded square has squares of its own. Heights count in the
distance, not in the squares. Bounds have a grain of tolerance for rounding, so that the answer is,
to the last digit, that of a look at every drone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import dist, inf, sqrt
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

if TYPE_CHECKING:
    from ..model import Point

FEW = 96
"""So many are looked at one by one: it takes as long as to look around in squares."""

_IN_A_SQUARE = 2.0
_SAME = 1e-9
"""Metres: drones that stand no farther apart than this need no squares."""
_GRAIN = 1e-12
"""What is lost by rounding is a smaller share of a number than this."""


class Placed(Protocol):
    """What stands somewhere, and in which order it comes among its like."""

    @property
    def index(self) -> int:
        """Its place in that order."""
        ...


T = TypeVar("T", bound=Placed)


class Places(Generic[T]):
    """Things and where they stand."""

    __slots__ = ("_grid", "_least", "_most", "_places")

    def __init__(self) -> None:
        self._places: dict[T, Point] = {}
        self._grid: _Grid[T] | None = None
        self._least, self._most = 0, FEW
        """While so many are here, the squares stay as they are."""

    def __len__(self) -> int:
        """Return how many are here."""
        return len(self._places)

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

    def _arrange(self) -> None:
        """Make new squares, for as many as there are now."""
        count = len(self._places)
        self._least, self._most = count // 2, max(2 * count, FEW)
        self._grid = _grid(self._places) if count > FEW else None


def _grid(places: Mapping[T, Point]) -> _Grid[T] | None:
    """Return squares for these; none where all stand in one place."""
    xs, ys, zs = zip(*places.values(), strict=True)
    wide, deep, share = max(xs) - min(xs), max(ys) - min(ys), _IN_A_SQUARE / len(places)
    if max(wide, deep) <= _SAME:
        return None
    side = max(sqrt(wide * deep * share), max(wide, deep) * share)
    grid: _Grid[T] = _Grid(_Strips(xs, side), _Strips(ys, side), _Strips(zs, inf))
    for thing, place in places.items():
        grid.square(place).add(thing, place)
    return grid


class _Grid(Generic[T]):
    """Squares that hold things: columns and rows, and one layer."""

    __slots__ = ("_columns", "_layer", "_rows", "_squares")

    def __init__(self, columns: _Strips, rows: _Strips, layer: _Strips) -> None:
        self._columns, self._rows, self._layer = columns, rows, layer
        self._squares: list[Places[T] | None] = [None] * (columns.count * rows.count)

    def square(self, place: Point) -> Places[T]:
        """Return the square for what stands at a place."""
        x, y, z = place
        self._layer.hold(z)
        index = self._rows.hold(y) * self._columns.count + self._columns.hold(x)
        square = self._squares[index]
        if square is None:
            square = self._squares[index] = Places()
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


def _reach(best: float, off: float) -> float:
    """Return how far to look sideways when it is so far already (squared); below 0: no more."""
    left = best * best * (1.0 + _GRAIN) - off
    return sqrt(left) if left >= 0.0 else -1.0


class _Strips:
    """Strips of equal breadth; the outermost hold also what stands beyond them."""

    __slots__ = ("_breadth", "_least", "_most", "_start", "count")

    def __init__(self, line: Sequence[float], breadth: float) -> None:
        self._start = self._least = min(line)
        self._most = max(line)
        self._breadth = breadth
        self.count = int((self._most - self._least) / breadth) + 1

    def hold(self, at: float) -> int:
        """Return the strip for what stands here, and remember how far the strips reach."""
        if at < self._least:
            self._least = at
        elif at > self._most:
            self._most = at
        return self._strip(at)

    def gap(self, at: float) -> float:
        """Return how far from here all that they hold is at least."""
        grain = self._grain(at)
        return max(self._least - at, at - self._most, grain) - grain

    def outward(self, at: float) -> Iterator[tuple[int, float]]:
        """Give the strips from here on, the nearest first, and how far away each is at least."""
        grain, away, breadth = self._grain(at), at - self._start, self._breadth
        here = self._strip(at)
        yield here, self.gap(at)
        low, high = here - 1, here + 1
        down = away - here * breadth if low >= 0 else inf
        up = high * breadth - away if high < self.count else inf
        while up < inf or down < inf:
            if up <= down:
                yield high, max(up, grain) - grain
                high += 1
                up = high * breadth - away if high < self.count else inf
            else:
                yield low, max(down, grain) - grain
                down = away - low * breadth if low else inf
                low -= 1

    def _grain(self, at: float) -> float:
        return _GRAIN * (abs(at) + abs(self._start) + self._most - self._least)

    def _strip(self, at: float) -> int:
        return min(max(int((at - self._start) / self._breadth), 0), self.count - 1)
