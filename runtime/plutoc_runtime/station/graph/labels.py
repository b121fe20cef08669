"""Where the words of an arrow stand: near where it leaves, and over nothing else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from .ground import Piece, Point

Area = tuple[float, float, float, float]
"""Left, top, right, bottom."""

_HIGH = 12.0
"""Of a line of words."""
_ABOVE = 5.0
"""Of an arrow that runs along the row; on one that runs across the rows words stand in the middle."""
_AIR = 4.0
_STAND = 18.0
"""Below a box, where missions stand."""
_ON_BOX, _ON_WORDS, _ON_WAY, _ON_STAND, _UPRIGHT, _FURTHER = 400.0, 200.0, 60.0, 50.0, 25.0, 0.4
"""What is paid for words over a box, over other words, over a way, over where missions stand, on a way
across the rows, and for each length of way between them and where the arrow begins."""


def labels(
    ways: Sequence[Sequence[Point]], widths: Sequence[float], boxes: Sequence[Area]
) -> list[Point | None]:
    """Return the middle of the foot of each arrow's words; None for one without any."""
    pieces = [(number, piece) for number, way in enumerate(ways) for piece in pairwise(way)]
    taken: list[Area] = []
    found: list[Point | None] = []
    for number, (way, width) in enumerate(zip(ways, widths, strict=True)):
        if not width:
            found.append(None)
            continue
        others = [piece for owner, piece in pieces if owner != number]
        tried = [
            (paid + _trouble(_area(at, width), others, taken, boxes), place, at)
            for place, (paid, at) in enumerate(_places(way, width))
        ]
        _, _, best = min(tried)
        taken.append(_area(best, width))
        found.append(best)
    return found


def _places(way: Sequence[Point], width: float) -> Iterator[tuple[float, Point]]:
    """Yield where words can stand along a way, and what is paid for it."""
    far = 0.0
    for (x, y), (to_x, to_y) in pairwise(way):
        length = abs(to_x - x) + abs(to_y - y)
        for part in (0.5, 0.25, 0.75):
            at = (x + (to_x - x) * part, y + (to_y - y) * part)
            paid = _FURTHER * (far + length * part)
            if y == to_y:
                yield paid, (at[0], at[1] - _ABOVE)
                yield paid, (at[0], at[1] + _ABOVE + _HIGH - _AIR)
            else:
                yield paid + _UPRIGHT, (at[0], at[1] + _AIR)
        far += length


def _area(at: Point, width: float) -> Area:
    return at[0] - width / 2, at[1] - _HIGH + _AIR / 2, at[0] + width / 2, at[1] + _AIR / 2


def _trouble(
    area: Area, ways: Sequence[Piece], words: Sequence[Area], boxes: Sequence[Area]
) -> float:
    paid = 0.0
    for (x, y), (to_x, to_y) in ways:
        paid += _ON_WAY * _meet(area, (min(x, to_x), min(y, to_y), max(x, to_x), max(y, to_y)))
    paid += sum(_ON_WORDS for one in words if _meet(area, one))
    for left, top, right, bottom in boxes:
        if _meet(area, (left, top, right, bottom + _STAND)):
            middle = (left + right) / 2
            stand = (middle - _STAND, bottom, middle + _STAND, bottom + _STAND)
            paid += _ON_BOX * _meet(area, (left, top, right, bottom))
            paid += _ON_STAND * _meet(area, stand)
    return paid


def _meet(one: Area, other: Area) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
