"""What can be said of a drawing by looking at it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

from pluto_fleet.station.graph.layout import Area, Layout, Point

Piece = tuple[Point, Point]

STAND = 13.0
LETTER = 5.4
"""About as wide as one is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pictured:
    """What a page draws."""

    laid: Layout
    ways: list[tuple[int, int]]
    """From which box to which."""
    words: list[Area]
    """What the statuses beside arrows cover, about."""

    @property
    def stands(self) -> list[Area]:
        """Where missions stand: at the foot of each box."""
        return [
            ((left + right) / 2 - STAND, bottom, (left + right) / 2 + STAND, bottom + STAND)
            for left, _, right, bottom in self.laid.boxes
        ]


def pictured(plain: Mapping[str, Any]) -> Pictured:
    """Return the same from what a page gets."""
    number = {block["name"]: place for place, block in enumerate(plain["blocks"])}
    edges = plain["edges"]
    laid = Layout(
        width=plain["width"],
        height=plain["height"],
        boxes=tuple(
            (one["x"], one["y"], one["x"] + one["w"], one["y"] + one["h"])
            for one in plain["blocks"]
        ),
        ways=tuple(tuple((x, y) for x, y in one["points"]) for one in edges),
        words=tuple((one["label"][0], one["label"][1]) if one["label"] else None for one in edges),
    )
    words = [
        _words(at, LETTER * len(", ".join(one["statuses"])))
        for one, at in zip(edges, laid.words, strict=True)
        if at is not None
    ]
    ways = [(number[one["source"]], number[one["target"]]) for one in edges]
    return Pictured(laid=laid, ways=ways, words=words)


def _words(at: Point, width: float) -> Area:
    return at[0] - width / 2, at[1] - 9, at[0] + width / 2, at[1] + 2


def overlap(one: Area, other: Area) -> bool:
    """Return whether two areas share more than an edge."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def covered(piece: Piece) -> Area:
    (x, y), (to_x, to_y) = piece
    return min(x, to_x), min(y, to_y), max(x, to_x), max(y, to_y)


def mistakes(laid: Layout, ways: Sequence[tuple[int, int]]) -> Iterator[str]:
    """Yield what must never be: boxes over boxes, ways through boxes, loose ends, slanted ways."""
    boxes = laid.boxes
    for (a, one), (b, other) in combinations(enumerate(boxes), 2):
        if overlap(one, other):
            yield f"box {a} lies over box {b}"
    for (source, target), way in zip(ways, laid.ways, strict=True):
        name = f"the way from {source} to {target}"
        if not touches(boxes[source], way[0]) or not touches(boxes[target], way[-1]):
            yield f"{name} has a loose end"
        for piece in pairwise(way):
            left, top, right, bottom = covered(piece)
            if not _same(left, right) and not _same(top, bottom):
                yield f"{name} is slanted"
            if left == right and top == bottom:
                yield f"{name} stands still"
            for number, box in enumerate(boxes):
                if _runs_through(covered(piece), box):
                    yield f"{name} runs through {number}"
    for left, top, right, bottom in [*boxes, *map(covered, _pieces(laid))]:
        if min(left, top) < 0 or right > laid.width or bottom > laid.height:
            yield "something lies outside"


def touches(box: Area, point: Point) -> bool:
    """Return whether a point is on the edge of a box, but not in a corner."""
    left, top, right, bottom = box
    x, y = point
    on_side = (_same(x, left) or _same(x, right)) and top < y < bottom
    return on_side or ((_same(y, top) or _same(y, bottom)) and left < x < right)


def lying_together(laid: Layout) -> Iterator[tuple[Piece, Piece]]:
    """Yield the pieces of different ways that cannot be told apart for a stretch."""
    pieces = [(number, piece) for number, way in enumerate(laid.ways) for piece in pairwise(way)]
    for (number, one), (its_number, other) in combinations(pieces, 2):
        if number == its_number:
            continue
        a, b = covered(one), covered(other)
        if _same(a[1], a[3]) and _same(b[1], b[3]) and _same(a[1], b[1]):
            together = min(a[2], b[2]) - max(a[0], b[0])
        elif _same(a[0], a[2]) and _same(b[0], b[2]) and _same(a[0], b[0]):
            together = min(a[3], b[3]) - max(a[1], b[1])
        else:
            continue
        if together > 1:
            yield one, other


def _pieces(laid: Layout) -> Iterator[Piece]:
    for way in laid.ways:
        yield from pairwise(way)


def _runs_through(piece: Area, box: Area) -> bool:
    """Return whether a piece of a way has a point within a box, its edges aside."""
    return (
        piece[0] < box[2] - 0.11
        and piece[2] > box[0] + 0.11
        and piece[1] < box[3] - 0.11
        and piece[3] > box[1] + 0.11
    )


def _same(one: float, other: float) -> bool:
    return abs(one - other) < 0.11  # a page gets them rounded
