"""From boxes and arrows to a picture: sizes, places, and the points of every arrow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from .grid import Grid, Spot, fit, grids
from .ground import Line, Point, Side
from .layers import layers
from .ports import Ports, ports
from .routes import Route, routes
from .tracks import Run, tracks

_MARGIN = 10.0
_APART = 8.0
"""Between two ways beside each other."""
_ROOM, _ROOM_BELOW = 16.0, 24.0
"""Between a box and the nearest way that runs along it: an arrow's head needs it; below a box missions
stand."""
_BEND, _CROSSING = 30.0, 60.0
"""What a bend and a crossing are as bad as, in lengths of way."""
_FAR = 1e5
"""More than any row is high."""


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


def drawn(
    sizes: Sequence[tuple[float, float]], ways: Sequence[tuple[int, int]], labels: Sequence[float]
) -> Laid:
    """Return the picture of boxes of these sizes, the first of which is where all begins.

    `labels` says of each way how much room its words need.
    """
    tries = [_laid(ground, ways, labels) for ground in grids(layers(len(sizes), ways), sizes)]
    return min(tries, key=_unrest)  # of equally good ones the first


def _unrest(laid: Laid) -> float:
    """Return how hard a picture is to read: long, bent and crossing ways, shown small."""
    pieces = [list(pairwise(way)) for way in laid.ways]
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for way in pieces for a, b in way)
    bends = sum(len(way) - 1 for way in pieces)
    every = [piece for way in pieces for piece in way]
    flat = [(a[0], b[0], a[1]) for a, b in every if a[1] == b[1]]
    steep = [(a[1], b[1], a[0]) for a, b in every if a[0] == b[0] and a[1] != b[1]]
    crossings = sum(
        min(x, to_x) < its_x < max(x, to_x) and min(its_y, its_to_y) < y < max(its_y, its_to_y)
        for x, to_x, y in flat
        for its_y, its_to_y, its_x in steep
    )
    return (length + _BEND * bends + _CROSSING * crossings) / fit(laid.width, laid.height)


def _laid(ground: Grid, ways: Sequence[tuple[int, int]], labels: Sequence[float]) -> Laid:
    found = routes(ground, ways)
    doors = ports(ground, ways, found)
    runs = _runs(ground, ways, found, doors)
    track: dict[tuple[int, Line], int] = {}
    count: dict[Line, int] = {}
    for line, there in runs.items():
        given = tracks(list(there.values()))
        track.update({(number, line): one for number, one in zip(there, given, strict=True)})
        count[line] = max(given) + 1
    xs, columns, width = _ruled(ground.columns, True, count, _wide(ground, ways, found, labels))
    ys, rows, height = _ruled(ground.rows, False, count, {})
    boxes = tuple(
        Placed(
            x=columns[spot.column] - spot.w / 2,
            y=rows[spot.row] + spot.y - spot.h / 2,
            w=spot.w,
            h=spot.h,
        )
        for spot in ground.spots
    )
    drawn: list[tuple[Point, ...]] = []
    for number, ((source, target), route, door) in enumerate(zip(ways, found, doors, strict=True)):
        start = _door(boxes[source], route.leaving.value, door.leaving)
        end = _door(boxes[target], route.entering.value, door.entering)
        x, y = start
        points = [start]
        for line in route.lines:
            at = (xs if line[0] else ys)[line[1]] + _APART * track[number, line]
            x, y = (at, y) if line[0] else (x, at)
            points.append((x, y))
        if route.lines:
            points.append((x, end[1]) if route.lines[-1][0] else (end[0], y))
        drawn.append((*points, end))
    return Laid(width=width, height=height, boxes=boxes, ways=tuple(drawn))


def _door(box: Placed, side: tuple[int, int], offset: float) -> Point:
    """Return where a way meets a box."""
    x, y = box.x + box.w / 2, box.y + box.h / 2
    if side[0]:
        return x + side[0] * box.w / 2, y + offset
    return x + offset, y + side[1] * box.h / 2


def _wide(
    ground: Grid,
    ways: Sequence[tuple[int, int]],
    found: Sequence[Route],
    labels: Sequence[float],
) -> dict[int, float]:
    """Return how wide gaps must be for the words of ways that are nowhere else."""
    wide: dict[int, float] = {}
    for (source, _), route, label in zip(ways, found, labels, strict=True):
        if route.leaving.flat and label and all(is_gap for is_gap, _ in route.lines):
            right = route.leaving is Side.RIGHT
            gap = route.lines[0][1] if route.lines else ground.spots[source].column + right
            wide[gap] = max(wide.get(gap, 0.0), label + _ROOM)
    return wide


def _ruled(
    sizes: Sequence[float], are_gaps: bool, count: Mapping[Line, int], least: Mapping[int, float]
) -> tuple[list[float], list[float], float]:
    """Return where the first track of each line is, the middles of what is between, and the end."""
    at, lines, middles = _MARGIN, list[float](), list[float]()
    room = _ROOM if are_gaps else _ROOM_BELOW
    for number in range(len(sizes) + 1):
        some = count.get((are_gaps, number), 0)
        tracks_wide = max(some - 1, 0) * _APART
        before = room if number else 0.0
        after = _ROOM if number < len(sizes) and (number or some) else 0.0
        spare = max(least.get(number, 0.0) - before - tracks_wide - after, 0.0) if number else 0.0
        lines.append(at + before + spare / 2)
        at += before + tracks_wide + after + spare
        if number < len(sizes):
            middles.append(at + sizes[number] / 2)
            at += sizes[number]
    return lines, middles, at + _MARGIN


def _runs(
    ground: Grid,
    ways: Sequence[tuple[int, int]],
    found: Sequence[Route],
    doors: Sequence[Ports],
) -> dict[Line, dict[int, Run]]:
    """Return what runs along each line, by the number of the way.

    Places along a line are told by rows or columns, and within these by the distance from the
    middle: what is between them has its size only when all tracks are known.
    """
    runs: dict[Line, dict[int, Run]] = {}
    for number, ((source, target), route, door) in enumerate(zip(ways, found, doors, strict=True)):
        first, last = ground.spots[source], ground.spots[target]
        for place, line in enumerate(route.lines):
            back = _end(line, route.lines[:place][::-1], first, door.leaving)
            ahead = _end(line, route.lines[place + 1 :], last, door.entering)
            runs.setdefault(line, {})[number] = Run(ends=(back, ahead))
    return runs


def _end(line: Line, rest: Sequence[Line], spot: Spot, offset: float) -> tuple[float, int]:
    """Return where a run along a line ends, and to which side its way goes on, to the box there."""
    is_gap, number = line
    across, along = (spot.column, spot.row) if is_gap else (spot.row, spot.column)
    if rest:
        at = (rest[0][1] - 0.5) * _FAR
        further = rest[1][1] - 0.5 if len(rest) > 1 else across
    else:
        at = along * _FAR + (spot.y if is_gap else 0.0) + offset
        further = across
    return at, 1 if further > number - 0.5 else -1
