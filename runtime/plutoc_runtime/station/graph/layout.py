"""From boxes and arrows to a picture: sizes, places, and the points of every arrow."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from .grid import Grid, fit, grids
from .ground import Line, Point, Side
from .labels import labels
from .layers import layers
from .ports import ports
from .routes import routes
from .rulers import Ruler, rulers
from .runs import runs_along
from .tracks import tracks
from .unrest import unrest

_MANY = 40
"""Of more boxes only one picture is tried."""
_TURN = 0.12
"""What a turn from row to row adds to the unrest of a picture."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """A box: its upper left corner, and its size."""

    x: float
    y: float
    w: float
    h: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Laid:
    """A picture, in the order of what was given."""

    width: float
    height: float
    boxes: tuple[Placed, ...]
    ways: tuple[tuple[Point, ...], ...]
    labels: tuple[Point | None, ...]
    """The middle of the foot of each arrow's words."""


def drawn(
    sizes: Sequence[tuple[float, float]], ways: Sequence[tuple[int, int]], widths: Sequence[float]
) -> Laid:
    """Return the picture of boxes of these sizes, the first of which is where all begins.

    `widths` says how wide the words of each way are; 0 where it has none.
    """
    some = grids(layers(len(sizes), ways), sizes)
    tries = [_laid(grid, ways, widths) for grid in some[: 1 if len(sizes) > _MANY else len(some)]]
    best = min(tries, key=_unrest)[1]  # of equally good ones the first
    boxes = [(one.x, one.y, one.x + one.w, one.y + one.h) for one in best.boxes]
    words = tuple(labels(best.ways, widths, boxes))
    return Laid(
        width=best.width, height=best.height, boxes=best.boxes, ways=best.ways, labels=words
    )


def _unrest(tried: tuple[Grid, Laid]) -> float:
    grid, laid = tried
    turns = len(grid.rows) - 1
    return unrest(laid.ways) * (1 + _TURN * turns) / fit(laid.width, laid.height)


def _laid(
    grid: Grid, ways: Sequence[tuple[int, int]], widths: Sequence[float]
) -> tuple[Grid, Laid]:
    """Return the picture of a grid, without words."""
    found = routes(grid, ways)
    doors = ports(grid, ways, found)
    track: dict[Line, Mapping[int, int]] = {}
    for line, runs in runs_along(grid, ways, found, doors).items():
        track[line] = dict(zip(runs, tracks(list(runs.values())), strict=True))
    count = {line: max(given.values()) + 1 for line, given in track.items()}
    across, down = rulers(grid, ways, found, widths, count)
    boxes = tuple(
        Placed(
            x=across.middles[spot.column] - spot.w / 2,
            y=down.middles[spot.row] + spot.y - spot.h / 2,
            w=spot.w,
            h=spot.h,
        )
        for spot in grid.spots
    )
    drawn_ways = tuple(
        _way(
            _door(boxes[source], route.leaving, door.leaving),
            _door(boxes[target], route.entering, door.entering),
            [(line[0], _at(line, track[line][number], across, down)) for line in route.lines],
        )
        for number, ((source, target), route, door) in enumerate(
            zip(ways, found, doors, strict=True)
        )
    )
    return grid, Laid(width=across.end, height=down.end, boxes=boxes, ways=drawn_ways, labels=())


def _at(line: Line, track: int, across: Ruler, down: Ruler) -> float:
    is_gap, number = line
    return (across if is_gap else down).track(number, track)


def _door(box: Placed, side: Side, offset: float) -> Point:
    """Return where a way meets a box."""
    x, y = box.x + box.w / 2, box.y + box.h / 2
    if side.flat:
        return x + side.value[0] * box.w / 2, y + offset
    return x + offset, y + side.value[1] * box.h / 2


def _way(start: Point, end: Point, lines: Sequence[tuple[bool, float]]) -> tuple[Point, ...]:
    """Return the points of a way that runs along these lines in turn."""
    x, y = start
    points = [start]
    for is_gap, at in lines:
        x, y = (at, y) if is_gap else (x, at)
        points.append((x, y))
    if lines:
        points.append((x, end[1]) if lines[-1][0] else (end[0], y))
    return tuple(_corners([*points, end]))


def _corners(points: Iterable[Point]) -> Iterator[Point]:
    """Yield the points at which a way begins, turns and ends."""
    apart: list[Point] = []
    for point in points:
        if not apart or point != apart[-1]:
            apart.append(point)
    yield apart[0]
    for (a, b), (_, c) in pairwise(pairwise(apart)):
        if not (a[0] == b[0] == c[0] or a[1] == b[1] == c[1]):
            yield b
    yield apart[-1]
