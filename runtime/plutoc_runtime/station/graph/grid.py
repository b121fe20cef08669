"""Where boxes stand: layers side by side in rows, of which every other one is read backwards.

So the last of a row stands above the first of the next, and a way back is seldom long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

BETWEEN = 26.0
"""Between boxes of one layer."""
WIDE, HIGH = 560.0, 400.0
"""The panel that the picture shall fit into without being made smaller."""
GAP, CHANNEL = 40.0, 44.0
"""What is about needed between columns, and between rows."""
_MOST_ROWS = 12
_SOME = 3


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


def grids(layers: Sequence[Sequence[int]], sizes: Sequence[tuple[float, float]]) -> list[Grid]:
    """Return the places of boxes of these sizes, in a few numbers of rows: those that fit best."""
    tries = [_folded(layers, sizes, rows) for rows in range(1, min(_MOST_ROWS, len(layers)) + 1)]
    tries.sort(key=lambda tried: -fit(*_about(tried)))  # of equally good ones the first
    return tries[:_SOME]


def fit(width: float, height: float) -> float:
    """Return how large a picture of this size can be shown in the panel."""
    return min(1.0, WIDE / width, HIGH / height)


def _about(tried: Grid) -> tuple[float, float]:
    """Return how large it is, as far as that can be said without the ways."""
    width = sum(tried.columns) + GAP * (len(tried.columns) + 0.5)
    return width, sum(tried.rows) + CHANNEL * (len(tried.rows) + 0.5)


def _folded(
    layers: Sequence[Sequence[int]], sizes: Sequence[tuple[float, float]], rows: int
) -> Grid:
    across = -(-len(layers) // rows)
    rows = -(-len(layers) // across)
    columns, heights = [0.0] * across, [0.0] * rows
    spots: dict[int, Spot] = {}
    for number, layer in enumerate(layers):
        row, place = divmod(number, across)
        onward = -1 if row % 2 else 1
        column = place if onward > 0 else across - 1 - place
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
                onward=onward,
            )
            y += h + BETWEEN
    return Grid(
        spots=tuple(spots[box] for box in sorted(spots)),
        columns=tuple(columns),
        rows=tuple(heights),
    )
