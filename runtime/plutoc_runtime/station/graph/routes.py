"""Which way each arrow takes: along the gaps between columns and the channels between rows.

No box stands in either, so no arrow runs through a box, whatever is chosen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from .grid import Grid, Spot
from .ground import Ground, Line, Piece, Side
from .taken import Taken

_BEND, _AGAINST = 30.0, 20.0
"""What is paid, in lengths of way: for a bend, and for leaving a box where it is entered, or the other
way about."""
_CLOSELY = 8
"""Of so many ways, the cheapest by themselves, it is looked what they cross."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """One arrow's way, by gaps and channels in turn; without any of them it is straight."""

    leaving: Side
    entering: Side
    lines: tuple[Line, ...]


def routes(grid: Grid, ways: Sequence[tuple[int, int]]) -> list[Route]:
    """Return a way for each arrow; the short ones choose first."""
    ground = Ground(grid)
    ends = [(ground.spots[source], ground.spots[target]) for source, target in ways]
    taken = Taken()
    found: dict[int, Route] = {}
    for number in sorted(range(len(ways)), key=lambda one: _apart(ground, *ends[one])):
        found[number], pieces = _best(ground, *ends[number], taken)
        taken.add(pieces)
    return [found[number] for number in range(len(ways))]


def _best(ground: Ground, source: Spot, target: Spot, taken: Taken) -> tuple[Route, list[Piece]]:
    """Return the way that costs least, and about where it runs."""
    tried: list[tuple[float, int, Route, list[Piece]]] = []
    for place, route in enumerate(_options(ground, source, target)):
        pieces = _pieces(ground, source, target, route)
        tried.append((_price(source, target, route, pieces), place, route, pieces))
    tried.sort(key=lambda one: one[:2])
    least = inf
    for price, _, route, pieces in tried[:_CLOSELY]:
        if price >= least:
            break
        whole = price + taken.trouble(pieces, least - price)
        if whole < least:
            least, best = whole, (route, pieces)
    return best


def _apart(ground: Ground, source: Spot, target: Spot) -> float:
    (x, y), (to_x, to_y) = ground.middle(source), ground.middle(target)
    return abs(x - to_x) + abs(y - to_y)


def _options(ground: Ground, source: Spot, target: Spot) -> Iterator[Route]:
    """Yield the ways from one box to another that bend four times at most."""
    for leaving, first in ground.doors(source):
        for entering, last in ground.doors(target):
            if source is target and leaving is entering:
                continue
            for lines in _joined(source, target, first, last):
                yield Route(leaving=leaving, entering=entering, lines=lines)
            if first == last and _faces(source, target, leaving, entering):
                yield Route(leaving=leaving, entering=entering, lines=())


def _faces(source: Spot, target: Spot, leaving: Side, entering: Side) -> bool:
    """Say whether a way can go straight from one box to the other."""
    (x, y), (to_x, to_y) = leaving.value, entering.value
    if x + to_x or y + to_y:
        return False
    if leaving.flat:
        ahead = (target.column - source.column) * x > 0
        return ahead and source.row == target.row and source.y == target.y
    return (target.row - source.row) * y > 0 and source.column == target.column


def _joined(source: Spot, target: Spot, first: Line, last: Line) -> Iterator[tuple[Line, ...]]:
    """Yield what leads from one line to another."""
    if first == last:
        yield (first,)
    elif first[0] != last[0]:
        yield first, last
    elif first[0]:
        low, high = sorted((source.row, target.row))
        for channel in range(low + 1, high + 1) if low < high else (low, low + 1):
            yield first, (False, channel), last
    else:
        for gap in dict.fromkeys(
            (source.column, source.column + 1, target.column, target.column + 1)
        ):
            yield first, (True, gap), last


def _pieces(ground: Ground, source: Spot, target: Spot, route: Route) -> list[Piece]:
    """Return about where a way runs."""
    x, y = ground.door(source, route.leaving)
    points = [(x, y)]
    for is_gap, number in route.lines:
        x, y = (ground.gaps[number], y) if is_gap else (x, ground.channels[number])
        points.append((x, y))
    end = ground.door(target, route.entering)
    if route.lines:
        points.append((x, end[1]) if route.entering.flat else (end[0], y))
    return list(pairwise([*points, end]))


def _price(source: Spot, target: Spot, route: Route, pieces: list[Piece]) -> float:
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in pieces)
    bends = len(route.lines) + 1 if route.lines else 0
    if len(route.lines) == 1 and abs(pieces[0][0][1] - pieces[-1][1][1]) < 1 and route.leaving.flat:
        bends += 2  # it goes where a straight one would
    against = (route.leaving.value[0] == -source.onward) + (
        route.entering.value[0] == target.onward
    )
    return length + _BEND * bends + _AGAINST * against
