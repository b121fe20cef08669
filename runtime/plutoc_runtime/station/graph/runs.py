"""What runs along each gap and each channel: the pieces of ways between their first and last bend."""

from __future__ import annotations

from collections.abc import Sequence

from .grid import Grid, Spot
from .ground import Line
from .ports import Ports
from .routes import Route
from .tracks import Run

_FAR = 1e5
"""More than any row is high."""


def runs_along(
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
