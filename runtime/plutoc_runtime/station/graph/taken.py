"""The ways that are there already, found by where they run."""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from collections.abc import Iterator, Sequence

from .ground import Piece, Point

_CROSS, _BESIDE = 30.0, 10.0
"""What is paid, in lengths of way, for crossing another way, and for running beside one."""

_Lines = dict[float, list[Piece]]
"""Pieces that run along, or across, by the one coordinate that stays the same."""


class Taken:
    """Pieces of ways, all of them along rows or across them."""

    def __init__(self) -> None:
        self._along: _Lines = {}
        self._across: _Lines = {}
        self._ys: list[float] = []
        self._xs: list[float] = []

    def add(self, pieces: Sequence[Piece]) -> None:
        """Add a way."""
        for piece in pieces:
            flat = piece[0][1] == piece[1][1]
            lines, keys = (self._along, self._ys) if flat else (self._across, self._xs)
            key = piece[0][flat]
            if key not in lines:
                lines[key] = []
                insort(keys, key)
            lines[key].append(piece)

    def trouble(self, pieces: Sequence[Piece], enough: float) -> float:
        """Return what a way has to pay; where that is enough to be refused, no more is looked at.

        Ways that begin or end at the same side of a box will have doors of their own there.
        """
        paid = 0.0
        start, end = pieces[0][0], pieces[-1][1]
        for one, to in pieces:
            for other in self._beside(one, to):
                paid += _BESIDE * _apart(other, one, to, start, end)
            for other in self._crossed(one, to):
                paid += _CROSS * _apart(other, one, to, start, end)
            if paid >= enough:
                break
        return paid

    def _beside(self, one: Point, to: Point) -> Iterator[Piece]:
        flat = one[1] == to[1]
        low, high = sorted((one[not flat], to[not flat]))
        for its, its_to in (self._along if flat else self._across).get(one[flat], ()):
            a, b = its[not flat], its_to[not flat]
            if max(a, b) >= low and min(a, b) <= high:
                yield its, its_to

    def _crossed(self, one: Point, to: Point) -> Iterator[Piece]:
        flat = one[1] == to[1]
        lines, keys = (self._across, self._xs) if flat else (self._along, self._ys)
        low, high = sorted((one[not flat], to[not flat]))
        at = one[flat]
        for key in keys[bisect_left(keys, low) : bisect_right(keys, high)]:
            for its, its_to in lines[key]:
                a, b = its[flat], its_to[flat]
                if max(a, b) >= at and min(a, b) <= at:
                    yield its, its_to


def _apart(other: Piece, one: Point, to: Point, start: Point, end: Point) -> bool:
    """Say whether two pieces that meet do so elsewhere than at a door that they share."""
    return not (
        (start in other and (one == start or to == start))
        or (end in other and (one == end or to == end))
    )
