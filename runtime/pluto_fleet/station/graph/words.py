"""Where the words of an arrow stand: near where it leaves, and over nothing else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from .grid import Point

Area = tuple[float, float, float, float]
"""Left, top, right, bottom."""

_HIGH, _ABOVE, _AIR, _STAND = 12.0, 5.0, 4.0, 18.0
"""Of a line of words; above an arrow along the row, below one across the rows; and of the place below a
box where missions stand."""
_ON_BOX, _ON_WORDS, _ON_WAY, _ON_STAND, _UPRIGHT, _FURTHER = 400.0, 200.0, 60.0, 50.0, 25.0, 0.4
"""What is paid for words over such things, on a way across the rows, and for each length of way between
them and where the arrow begins."""


def words(
    ways: Sequence[Sequence[Point]], widths: Sequence[float], boxes: Sequence[Area]
) -> list[Point | None]:
    """Return the middle of the foot of each arrow's words; None for one without any."""
    paying = [(_ON_BOX, box) for box in boxes]
    for left, _, right, bottom in boxes:
        middle = (left + right) / 2
        paying.append((_ON_STAND, (middle - _STAND, bottom, middle + _STAND, bottom + _STAND)))
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


def _places(way: Sequence[Point]) -> Iterator[tuple[float, Point]]:
    """Yield where words can stand along a way, and what is paid for it."""
    far = 0.0
    for (x, y), (to_x, to_y) in pairwise(way):
        length = abs(to_x - x) + abs(to_y - y)
        for part in (0.5, 0.25, 0.75):
            at_x, at_y = x + (to_x - x) * part, y + (to_y - y) * part
            paid = _FURTHER * (far + length * part)
            if y == to_y:
                yield paid, (at_x, at_y - _ABOVE)
                yield paid, (at_x, at_y + _HIGH)
            else:
                yield paid + _UPRIGHT, (at_x, at_y + _AIR)
        far += length


def _area(at: Point, width: float) -> Area:
    return at[0] - width / 2, at[1] - _HIGH + _AIR / 2, at[0] + width / 2, at[1] + _AIR / 2


def _covered(one: Point, other: Point) -> Area:
    (left, right), (top, bottom) = sorted((one[0], other[0])), sorted((one[1], other[1]))
    return left, top, right, bottom


def _meet(one: Area, other: Area) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
