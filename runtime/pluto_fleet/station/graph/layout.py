"""Layered graph layout from top to bottom: the positions of boxes and the routes of edges.

An edge to the next layer runs in the channel between the two. One that skips layers runs beside all boxes, on
the left; one that leads back, on the right. So no edge crosses a box.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

Point = tuple[float, float]
Area = tuple[float, float, float, float]
"""Left, top, right, bottom."""
Ways = Sequence[tuple[int, int]]
"""Edges, as pairs of box numbers."""


_SWEEPS = 6
_BETWEEN = 26.0
"""Between boxes of one layer."""
_MARGIN, _APART, _ABOVE, _BELOW, _LABEL = 10.0, 8.0, 16.0, 24.0, 14.0
"""Around the picture; between two ways; above a box, where an arrow's head has its place; below it, where
missions stand; and the height that the words of a way need."""
_STEP, _NEAR, _CORNER, _STAND = 2.0, (8.0, 6.0, 3.0), 7.0, 14.0
"""Of the places for the end of a way; what shall be between two ends, and what must do; what is left free
of a side at each corner, and in the middle of its foot."""
_LINE, _OVER, _AIR, _FOOT = 12.0, 5.0, 4.0, 18.0
"""Of a line of words; above a level piece of an arrow, below an upright one; and of the place below a
box where missions stand."""
_ON_BOX, _ON_WORDS, _ON_WAY, _ON_STAND, _UPRIGHT, _FURTHER = 400.0, 200.0, 60.0, 50.0, 25.0, 0.4
"""What is paid for words over such things, on an upright piece, and for each length of way between
them and where the arrow begins."""
_FAR = 1e5
"""Further than any picture reaches."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A layout, in the order of the given boxes and edges."""

    width: float
    height: float
    boxes: tuple[Area, ...]
    ways: tuple[tuple[Point, ...], ...]
    words: tuple[Point | None, ...]
    """The bottom centre of each edge's label."""


def drawn(sizes: Sequence[tuple[float, float]], ways: Ways, widths: Sequence[float]) -> Layout:
    """Return the layout of boxes of these sizes, of which the first is the start.

    `widths` are those of the edges' labels; 0 for none.
    """
    found = layers(len(sizes), ways)
    level = {box: number for number, layer in enumerate(found) for box in layer}
    middle = {box: x for layer in found for box, x in _middles(layer, sizes)}
    ends = _ends(sizes, ways, level, middle)
    reach = max(abs(x) + sizes[box][0] / 2 for box, x in middle.items())
    lane = _lanes(ways, level, reach)
    runs = _runs(ways, level, ends, lane)
    track = {channel: _tracks(there) for channel, there in runs.items()}
    tops, lines = _heights(sizes, found, ways, widths, level, track)
    left = min([-reach, *lane.values()]) - _MARGIN
    boxes = [
        (
            middle[box] - left - w / 2,
            tops[level[box]],
            middle[box] - left + w / 2,
            tops[level[box]] + h,
        )
        for box, (w, h) in enumerate(sizes)
    ]
    paths = []
    for number, (source, target) in enumerate(ways):
        start, end = (x - left for x in ends[number])
        points = [(start, boxes[source][3])]
        first, last = level[source] + 1, level[target]
        if number in lane:
            aside = lane[number] - left
            y, to_y = (lines[one] + _APART * track[one][number] for one in (first, last))
            points += [(start, y), (aside, y), (aside, to_y), (end, to_y)]
        elif start != end:
            y = lines[first] + _APART * track[first][number]
            points += [(start, y), (end, y)]
        paths.append((*points, (end, boxes[target][1])))
    width = max([reach, *lane.values()]) + _MARGIN - left
    height = lines[-1] + _APART * max(track[len(found)].values(), default=0) + _MARGIN
    return Layout(
        width=width,
        height=height,
        boxes=tuple(boxes),
        ways=tuple(paths),
        words=tuple(labels(paths, widths, boxes, (width, height))),
    )


def layers(count: int, ways: Ways) -> list[list[int]]:
    """Return the layers of boxes, each in an order with few crossings.

    Back edges are ignored; all others lead to a later layer.
    """
    leaving, before, after = ([list[int]() for _ in range(count)] for _ in range(3))
    for source, target in ways:
        leaving[source].append(target)
    met: set[int] = set()
    left: dict[int, int] = {}
    """Boxes in depth-first postorder."""

    def walk(box: int) -> None:
        met.add(box)
        for target in leaving[box]:
            if target not in met:
                walk(target)
            if target in left:
                after[box].append(target)
                before[target].append(box)
        left[box] = 0

    for box in range(count):
        if box not in met:
            walk(box)
    found: list[list[int]] = [[] for _ in range(count)]
    for box in reversed(list(left)):
        found[left[box]].append(box)
        for target in after[box]:
            left[target] = max(left[target], left[box] + 1)
    return _untangled([sorted(layer) for layer in found if layer], before, after)


def _untangled(
    found: list[list[int]], before: list[list[int]], after: list[list[int]]
) -> list[list[int]]:
    """Return the layers sorted by the barycentre of each box's neighbours."""
    at = {box: place for layer in found for box, place in _spread(layer)}
    for joined, order in ((before, found), (after, found[::-1])) * (_SWEEPS // 2):
        for layer in order:
            for box in layer:
                if joined[box]:
                    at[box] = sum(at[one] for one in joined[box]) / len(joined[box])
            layer.sort(key=at.__getitem__)
            at.update(_spread(layer))
    return found


def _spread(layer: list[int]) -> list[tuple[int, float]]:
    return [(box, place - (len(layer) - 1) / 2) for place, box in enumerate(layer)]


def _middles(
    layer: Sequence[int], sizes: Sequence[tuple[float, float]]
) -> Iterator[tuple[int, float]]:
    """Yield the centre of each box of a layer; 0 is the centre of the picture."""
    x = -(sum(sizes[box][0] for box in layer) + _BETWEEN * (len(layer) - 1)) / 2
    for box in layer:
        yield box, x + sizes[box][0] / 2
        x += sizes[box][0] + _BETWEEN


def _ends(
    sizes: Sequence[tuple[float, float]],
    ways: Ways,
    level: dict[int, int],
    middle: dict[int, float],
) -> list[tuple[float, float]]:
    """Return where each edge leaves the bottom of its box, and enters the top of another."""

    def side(number: int) -> float:
        """Return the horizontal destination of an edge: beside the boxes, or in the next layer."""
        source, target = ways[number]
        step = level[target] - level[source]
        return middle[target] - middle[source] if step == 1 else inf if step < 1 else -inf

    busy: defaultdict[int, list[float]] = defaultdict(list)
    start, end = [0.0] * len(ways), [0.0] * len(ways)
    order = sorted(range(len(ways)), key=lambda one: (abs(side(one)), side(one)))
    for number in order:
        source, _ = ways[number]
        aside = (side(number) > 0) - (side(number) < 0) or 1
        room = sizes[source][0] / 2 - _CORNER
        wanted = aside * (room if abs(side(number)) == inf else _STAND + 4)
        there = busy[level[source] + 1]
        start[number] = _free(middle[source], wanted, room, there, clear=_STAND)
        there.append(start[number])
    for number in order:
        source, target = ways[number]
        there = list(busy[level[target]])
        room = sizes[target][0] / 2 - _CORNER
        if level[target] - level[source] == 1:
            there.remove(start[number])  # straight down is best
            wanted = start[number] - middle[target]
        else:
            wanted = -room if side(number) < 0 else room
        end[number] = _free(middle[target], wanted, room, there)
        busy[level[target]].append(end[number])
    return list(zip(start, end, strict=True))


def _free(
    middle: float, wanted: float, room: float, busy: Iterable[float], clear: float = 0.0
) -> float:
    """Return the place nearest to the wanted one that keeps its distance from all others."""
    busy = list(busy)
    steps = int(room / _STEP)
    places = [_STEP * step for step in range(-steps, steps + 1)]
    places.sort(key=lambda one: (abs(one) < clear, abs(one - wanted), abs(one)))
    if abs(wanted) <= room and abs(wanted) >= clear:
        places.insert(0, wanted)
    space = {one: min((abs(middle + one - at) for at in busy), default=inf) for one in places}
    free = [one for near in _NEAR for one in places if space[one] >= near]
    return middle + (free[0] if free else max(places, key=space.__getitem__))


def _lanes(ways: Ways, level: dict[int, int], reach: float) -> dict[int, float]:
    """Return the lanes of edges beside the boxes: short ones nearest to them."""
    found: dict[int, float] = {}
    taken: list[tuple[int, int, int, int]] = []
    spans = {
        number: (level[source] + 1, level[target])
        for number, (source, target) in enumerate(ways)
        if level[target] - level[source] != 1
    }
    for number in sorted(spans, key=lambda one: (abs(spans[one][1] - spans[one][0]), one)):
        first, last = spans[number]
        side = 1 if last < first else -1
        low, high = min(first, last), max(first, last)
        beside = [at for at, one, a, b in taken if one == side and a <= high and low <= b]
        place = max(beside, default=0) + 1
        taken.append((place, side, low, high))
        found[number] = side * (reach + _APART * (place + 1))
    return found


def _runs(
    ways: Ways,
    level: dict[int, int],
    ends: Sequence[tuple[float, float]],
    lane: dict[int, float],
) -> dict[int, dict[int, tuple[float, float]]]:
    """Return the horizontal segments in each channel, by number: the first is above the first layer."""
    found: defaultdict[int, dict[int, tuple[float, float]]] = defaultdict(dict)
    for channel in range(max(level.values()) + 2):
        found[channel] = {}
    for number, (source, target) in enumerate(ways):
        start, end = ends[number]
        if number in lane:
            found[level[source] + 1][number] = start, lane[number]
            found[level[target]][number] = lane[number], end
        elif start != end:
            found[level[target]][number] = start, end
    return found


def _tracks(runs: dict[int, tuple[float, float]]) -> dict[int, int]:
    """Return the track of each edge, from 0, without overlaps and with few crossings."""
    order = sorted(
        runs, key=lambda one: -runs[one][0] if runs[one][0] < runs[one][1] else runs[one][0]
    )
    found: dict[int, int] = {}
    for number in order:
        low, high = sorted(runs[number])
        beside = [found[it] for it in found if min(runs[it]) <= high and low <= max(runs[it])]
        found[number] = max(beside, default=-1) + 1
    return found


def _heights(
    sizes: Sequence[tuple[float, float]],
    found: Sequence[Sequence[int]],
    ways: Ways,
    widths: Sequence[float],
    level: dict[int, int],
    track: dict[int, dict[int, int]],
) -> tuple[list[float], list[float]]:
    """Return the top of each layer, and the first track of each channel."""
    said = [0] * (len(found) + 1)
    for (source, _), width in zip(ways, widths, strict=True):
        said[level[source] + 1] += width > 0
    y, tops, lines = _MARGIN, list[float](), list[float]()
    for number in range(len(found) + 1):
        lines.append(y + (_BELOW if number else 0.0))
        y = lines[-1] + _APART * max(track[number].values(), default=0)
        y = max(y, lines[-1] + _LABEL * said[number])
        y += _ABOVE if track[number] or number else 0.0
        if number < len(found):
            tops.append(y)
            y += max(sizes[box][1] for box in found[number])
    return tops, lines


def labels(
    ways: Sequence[Sequence[Point]],
    widths: Sequence[float],
    boxes: Sequence[Area],
    whole: Point,
) -> list[Point | None]:
    """Return the bottom centre of each edge's label; None for one without.

    `whole` is the size of the picture.
    """
    paying = [(_ON_BOX, box) for box in (*boxes, *_outside(*whole))]
    for left, _, right, bottom in boxes:
        middle = (left + right) / 2
        paying.append((_ON_STAND, (middle - _FOOT, bottom, middle + _FOOT, bottom + _FOOT)))
    pieces = [
        (number, _covered(*piece)) for number, way in enumerate(ways) for piece in pairwise(way)
    ]
    found: list[Point | None] = []
    for number, (way, width) in enumerate(zip(ways, widths, strict=True)):
        if not width:
            found.append(None)
            continue
        there = [*paying, *((_ON_WAY, piece) for owner, piece in pieces if owner != number)]
        _, best = min(
            (paid + sum(price for price, one in there if _meet(area, one)), at)
            for paid, at in _places(way)
            for area in (_area(at, width),)
        )
        paying.append((_ON_WORDS, _area(best, width)))
        found.append(best)
    return found


def _outside(width: float, height: float) -> list[Area]:
    """Return the areas around the picture."""
    return [
        (-_FAR, -_FAR, _FAR, 0.0),
        (-_FAR, -_FAR, 0.0, _FAR),
        (width, -_FAR, _FAR, _FAR),
        (-_FAR, height, _FAR, _FAR),
    ]


def _places(way: Sequence[Point]) -> Iterator[tuple[float, Point]]:
    """Yield candidate positions of a label along an edge, with their costs."""
    far = 0.0
    for (x, y), (to_x, to_y) in pairwise(way):
        length = abs(to_x - x) + abs(to_y - y)
        for part in (0.5, 0.25, 0.75):
            at_x, at_y = x + (to_x - x) * part, y + (to_y - y) * part
            paid = _FURTHER * (far + length * part)
            if y == to_y:
                yield paid, (at_x, at_y - _OVER)
                yield paid, (at_x, at_y + _LINE)
            else:
                yield paid + _UPRIGHT, (at_x, at_y + _AIR)
        far += length


def _area(at: Point, width: float) -> Area:
    return at[0] - width / 2, at[1] - _LINE + _AIR / 2, at[0] + width / 2, at[1] + _AIR / 2


def _covered(one: Point, other: Point) -> Area:
    (left, right), (top, bottom) = sorted((one[0], other[0])), sorted((one[1], other[1]))
    return left, top, right, bottom


def _meet(one: Area, other: Area) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
