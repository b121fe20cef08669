"""How far columns and rows are apart, and where the ways between them run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .grid import Grid
from .ground import Line, Side
from .routes import Route

_MARGIN = 10.0
_APART = 8.0
"""Between two ways beside each other."""
_ROOM, _ROOM_BELOW = 16.0, 24.0
"""Between a box and the nearest way that runs along it: an arrow's head needs it; below a box missions
stand."""
_AIR = 10.0
"""Beside words."""

Room = tuple[float, float]
"""What is needed in a gap before its ways, and after them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ruler:
    """Places across columns, or down rows."""

    lines: tuple[float, ...]
    """The first track of each gap, or channel."""
    middles: tuple[float, ...]
    """Of columns, or rows."""
    end: float

    def track(self, line: int, number: int) -> float:
        """Return where a track runs."""
        return self.lines[line] + _APART * number


def rulers(
    grid: Grid,
    ways: Sequence[tuple[int, int]],
    found: Sequence[Route],
    widths: Sequence[float],
    count: Mapping[Line, int],
) -> tuple[Ruler, Ruler]:
    """Return the places of columns and rows; `count` says how many tracks each line has."""
    across = [count.get((True, number), 0) for number in range(len(grid.columns) + 1)]
    down = [count.get((False, number), 0) for number in range(len(grid.rows) + 1)]
    below = [(0.0, 0.0)] + [(_ROOM_BELOW, 0.0)] * len(grid.rows)
    return (
        _ruled(grid.columns, across, _words(grid, ways, found, widths)),
        _ruled(grid.rows, down, below),
    )


def _words(
    grid: Grid,
    ways: Sequence[tuple[int, int]],
    found: Sequence[Route],
    widths: Sequence[float],
) -> list[Room]:
    """Return the room that gaps need for the words of ways that are nowhere else."""
    before, after = ([0.0] * (len(grid.columns) + 1) for _ in range(2))
    for (source, _), route, width in zip(ways, found, widths, strict=True):
        if not route.leaving.flat or not width or len(route.lines) > 1:
            continue
        right = route.leaving is Side.RIGHT
        gap = grid.spots[source].column + right
        if not route.lines:  # half of it on either side of what else is there
            before[gap] = max(before[gap], (width + _AIR) / 2)
            after[gap] = max(after[gap], (width + _AIR) / 2)
        elif right:
            before[gap] = max(before[gap], width + _AIR)
        else:
            after[gap] = max(after[gap], width + _AIR)
    return list(zip(before, after, strict=True))


def _ruled(sizes: Sequence[float], count: Sequence[int], rooms: Sequence[Room]) -> Ruler:
    at, lines, middles = _MARGIN, list[float](), list[float]()
    last = len(sizes)
    for number, (some, (before, after)) in enumerate(zip(count, rooms, strict=True)):
        if some or number not in (0, last):
            at += max(_ROOM, before) if number else 0.0
            lines.append(at)
            at += max(some - 1, 0) * _APART + (max(_ROOM, after) if number < last else 0.0)
        else:
            lines.append(at)
        if number < last:
            middles.append(at + sizes[number] / 2)
            at += sizes[number]
    return Ruler(lines=tuple(lines), middles=tuple(middles), end=at + max(_MARGIN, rooms[-1][0]))
