"""The grid as ways see it: gaps between columns, channels between rows, and boxes in between."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import Enum

from .grid import CHANNEL, GAP, Grid, Spot

Point = tuple[float, float]
Piece = tuple[Point, Point]
Line = tuple[bool, int]
"""A gap (True) or a channel (False), by its number: the first is before the first column or row."""

CLEAR = 12.0
"""Between the middle of a box and others that a way from there can pass."""
_FAR = 3
"""The most columns between whose boxes a way can pass."""


class Side(Enum):
    """A side of a box, and which way is out there."""

    LEFT = (-1, 0)
    RIGHT = (1, 0)
    TOP = (0, -1)
    BOTTOM = (0, 1)

    @property
    def flat(self) -> bool:
        """A way leaves it along the row."""
        return self in (Side.LEFT, Side.RIGHT)


class Ground:
    """A grid, with about the coordinates that it will have."""

    def __init__(self, grid: Grid) -> None:
        self.spots = grid.spots
        self._cells: dict[tuple[int, int], list[Spot]] = {}
        for spot in grid.spots:
            self._cells.setdefault((spot.row, spot.column), []).append(spot)
        self.gaps, self.columns = _ruled(grid.columns, GAP)
        self.channels, self.rows = _ruled(grid.rows, CHANNEL)

    def middle(self, spot: Spot) -> Point:
        """Return about where the middle of a box is."""
        return self.columns[spot.column], self.rows[spot.row] + spot.y

    def door(self, spot: Spot, side: Side) -> Point:
        """Return about where a way leaves a box."""
        x, y = self.middle(spot)
        return x + side.value[0] * spot.w / 2, y + side.value[1] * spot.h / 2

    def doors(self, spot: Spot) -> Iterator[tuple[Side, Line]]:
        """Yield the sides of a box, and the lines that one comes to from there."""
        for side in (Side.RIGHT, Side.LEFT):
            for gap in self.reach(spot, side):
                yield side, (True, gap)
        if spot.bottom:
            yield Side.BOTTOM, (False, spot.row + 1)
        if spot.top:
            yield Side.TOP, (False, spot.row)

    def reach(self, spot: Spot, side: Side) -> Iterator[int]:
        """Yield the gaps that a way along the row comes to before a box is in its way."""
        step, column = side.value[0], spot.column
        for _ in range(_FAR):
            yield column + (step > 0)
            column += step
            if not 0 <= column < len(self.columns):
                return
            for one in self._cells.get((spot.row, column), ()):
                if abs(one.y - spot.y) < one.h / 2 + CLEAR:
                    return


def _ruled(sizes: Sequence[float], between: float) -> tuple[list[float], list[float]]:
    """Return the middles of what is between, and of what has these sizes."""
    at, gaps, middles = 0.0, [between / 2], list[float]()
    for size in sizes:
        at += between
        middles.append(at + size / 2)
        at += size
        gaps.append(at + between / 2)
    return gaps, middles
