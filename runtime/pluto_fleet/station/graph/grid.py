"""Where boxes stand: layers side by side in rows, of which every other one is read backwards.

So the last of a row stands above the first of the next, and a way back is seldom long. Between columns
are gaps, and between rows channels: there ways run, and never through a box.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

BETWEEN = 26.0
"""Between boxes of one layer."""

Point = tuple[float, float]
Line = tuple[bool, int]
"""A gap (True) or a channel (False), by its number: the first is before the first column or row."""
Room = tuple[float, float]
"""Of a gap or a channel: what lies before its first track, and from there to its end."""


class Side(Enum):
    """A side of a box, and which way is out there."""

    LEFT = (-1, 0)
    RIGHT = (1, 0)
    TOP = (0, -1)
    BOTTOM = (0, 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spot:
    """Where a box stands, and how large it is."""

    row: int
    column: int
    y: float
    """Of its middle, from the middle of its row."""
    w: float
    h: float
    top: bool
    """No box of its layer is above it."""
    bottom: bool
    onward: int
    """1: in its row one goes on to the right; -1: to the left."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """All boxes, and how large columns and rows must be for them."""

    spots: tuple[Spot, ...]
    columns: tuple[float, ...]
    rows: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """Where the lines of a grid are, and the middles of its columns and rows."""

    gaps: tuple[float, ...]
    columns: tuple[float, ...]
    width: float
    channels: tuple[float, ...]
    rows: tuple[float, ...]
    height: float

    def door(self, spot: Spot, side: Side, aside: float = 0.0) -> Point:
        """Return where a way leaves a box that is so far from the middle of that side."""
        x, y = side.value
        across, down = (0.0, aside) if x else (aside, 0.0)
        return (
            self.columns[spot.column] + x * spot.w / 2 + across,
            self.rows[spot.row] + spot.y + y * spot.h / 2 + down,
        )


def folded(
    layers: Sequence[Sequence[int]], sizes: Sequence[tuple[float, float]], rows: int
) -> Grid:
    """Return the places of boxes of these sizes, in so many rows at most."""
    long = -(-len(layers) // rows)
    columns, heights = [0.0] * long, [0.0] * -(-len(layers) // long)
    spots: dict[int, Spot] = {}
    for number, layer in enumerate(layers):
        row, place = divmod(number, long)
        column = long - 1 - place if row % 2 else place
        height = sum(sizes[box][1] for box in layer) + BETWEEN * (len(layer) - 1)
        columns[column] = max([columns[column], *(sizes[box][0] for box in layer)])
        heights[row] = max(heights[row], height)
        y = -height / 2
        for box in layer:
            w, h = sizes[box]
            spots[box] = Spot(
                row=row,
                column=column,
                y=y + h / 2,
                w=w,
                h=h,
                top=box == layer[0],
                bottom=box == layer[-1],
                onward=-1 if row % 2 else 1,
            )
            y += h + BETWEEN
    every = tuple(spots[box] for box in sorted(spots))
    return Grid(spots=every, columns=tuple(columns), rows=tuple(heights))


def framed(grid: Grid, gaps: Iterable[Room], channels: Iterable[Room]) -> Frame:
    """Return where everything is if gaps and channels have this room."""
    gap, columns, width = _ruled(grid.columns, gaps)
    channel, rows, height = _ruled(grid.rows, channels)
    return Frame(gaps=gap, columns=columns, width=width, channels=channel, rows=rows, height=height)


def _ruled(
    sizes: Sequence[float], rooms: Iterable[Room]
) -> tuple[tuple[float, ...], tuple[float, ...], float]:
    at, lines, middles = 0.0, list[float](), list[float]()
    for (before, behind), size in zip(rooms, (*sizes, 0.0), strict=True):
        lines.append(at + before)
        middles.append(at + before + behind + size / 2)
        at += before + behind + size
    return tuple(lines), tuple(middles[:-1]), at
