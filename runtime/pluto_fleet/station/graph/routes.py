"""Which way each arrow takes: along gaps and channels, with few bends and few crossings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from .grid import Frame, Grid, Line, Point, Side, Spot

_BEND, _AGAINST, _CROSS, _BESIDE = 30.0, 20.0, 30.0, 10.0
"""What is paid, in lengths of way: for a bend, for leaving a box where it is entered or the other way
about, for crossing another way, and for running beside one."""
_CLOSELY = 8
"""Of so many ways, the cheapest by themselves, it is looked what they cross."""

Piece = tuple[Point, Point]


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """One arrow's way, by gaps and channels in turn; without any of them it is straight."""

    source: Spot
    target: Spot
    leaving: Side
    entering: Side
    lines: tuple[Line, ...]

    def points(
        self, frame: Frame, doors: tuple[float, float] = (0.0, 0.0), tracks: Sequence[float] = ()
    ) -> list[Point]:
        """Return where it runs: how far from the middles of sides, and on which tracks."""
        x, y = frame.door(self.source, self.leaving, doors[0])
        end = frame.door(self.target, self.entering, doors[1])
        found = [(x, y)]
        for place, (is_gap, number) in enumerate(self.lines):
            at = (frame.gaps if is_gap else frame.channels)[number]
            at += tracks[place] if tracks else 0.0
            x, y = (at, y) if is_gap else (x, at)
            found.append((x, y))
        if self.lines:
            found.append((x, end[1]) if self.lines[-1][0] else (end[0], y))
        return [*found, end]


def routes(grid: Grid, ways: Sequence[tuple[int, int]], frame: Frame) -> tuple[list[Route], float]:
    """Return a way for each arrow, and what is paid for all; the short ones choose first.

    The frame says about where everything will be.
    """
    options = [
        sorted(
            (
                (_price(route.points(frame), route), place, route)
                for place, route in enumerate(_options(grid.spots[source], grid.spots[target]))
            ),
            key=lambda one: one[:2],
        )[:_CLOSELY]
        for source, target in ways
    ]
    taken: list[Piece] = []
    found: dict[int, Route] = {}
    paid = 0.0
    for number in sorted(range(len(ways)), key=lambda one: options[one][0][0]):
        least = inf
        for price, _, route in options[number]:
            if price >= least:
                break
            whole = price + _trouble(route.points(frame), taken, least - price)
            if whole < least:
                least, found[number] = whole, route
        taken += pairwise(found[number].points(frame))
        paid += least
    return [found[number] for number in range(len(ways))], paid


def _options(source: Spot, target: Spot) -> Iterator[Route]:
    """Yield the ways from one box to another that bend four times at most."""
    for leaving, first in _doors(source):
        for entering, last in _doors(target):
            if source is target and leaving is entering:
                continue
            for lines in _joined(source, target, first, last):
                if lines or _faces(source, target, leaving, entering):
                    yield Route(
                        source=source,
                        target=target,
                        leaving=leaving,
                        entering=entering,
                        lines=lines,
                    )


def _doors(spot: Spot) -> Iterator[tuple[Side, Line]]:
    """Yield the sides of a box, and the lines that they look on."""
    yield Side.RIGHT, (True, spot.column + 1)
    yield Side.LEFT, (True, spot.column)
    if spot.bottom:
        yield Side.BOTTOM, (False, spot.row + 1)
    if spot.top:
        yield Side.TOP, (False, spot.row)


def _faces(source: Spot, target: Spot, leaving: Side, entering: Side) -> bool:
    """Say whether a way can go straight from a side to one that looks on the same line."""
    (x, y), opposite = leaving.value, entering.value
    if (-x, -y) != opposite:
        return False
    return (source.row, source.y) == (target.row, target.y) if x else source.column == target.column


def _joined(source: Spot, target: Spot, first: Line, last: Line) -> Iterator[tuple[Line, ...]]:
    """Yield what leads from one line to another."""
    if first == last:
        yield ()
        yield (first,)
    elif first[0] != last[0]:
        yield first, last
    elif first[0]:
        low, high = sorted((source.row, target.row))
        for channel in range(low + (low < high), max(high, low + 1) + 1):
            yield first, (False, channel), last
    else:
        low, high = sorted((source.column, target.column))
        for gap in {low, low + 1, high, high + 1}:
            yield first, (True, gap), last


def _price(points: list[Point], route: Route) -> float:
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in pairwise(points))
    bends = len(route.lines) + 1 if route.lines else 0
    against = (route.leaving.value[0] == -route.source.onward) + (
        route.entering.value[0] == route.target.onward
    )
    return length + _BEND * bends + _AGAINST * against


def _trouble(points: list[Point], taken: Sequence[Piece], enough: float) -> float:
    """Return what is to be paid for the ways that are there already, or that it is enough.

    Those that begin or end at the same side of a box will have doors of their own there.
    """
    paid = 0.0
    start, end = points[0], points[-1]
    for one, to in pairwise(points):
        (left, right), (top, bottom) = sorted((one[0], to[0])), sorted((one[1], to[1]))
        for its, its_to in taken:
            if (
                (its[0] <= right or its_to[0] <= right)
                and (its[0] >= left or its_to[0] >= left)
                and (its[1] <= bottom or its_to[1] <= bottom)
                and (its[1] >= top or its_to[1] >= top)
                and not (one == start and start in (its, its_to))
                and not (to == end and end in (its, its_to))
            ):
                paid += _BESIDE if (its[1] == its_to[1]) == (top == bottom) else _CROSS
        if paid >= enough:
            break
    return paid
