"""Which of the ways in one gap, or one channel, runs beside which: so that few of them cross."""

from __future__ import annotations

from collections.abc import Sequence

from .grid import Line, Spot
from .routes import Route

_ROUNDS = 8
_FAR = 1e5
"""More than any row is high."""

End = tuple[float, int]
"""Where along its line a run ends, and to which side its way goes on there."""
Run = tuple[End, End]


def tracks(
    found: Sequence[Route], doors: Sequence[tuple[float, float]]
) -> dict[Line, dict[int, int]]:
    """Return for each line the tracks, from 0, of the ways along it; ways on one do not meet."""
    runs: dict[Line, dict[int, Run]] = {}
    for number, (route, (leaving, entering)) in enumerate(zip(found, doors, strict=True)):
        for place, line in enumerate(route.lines):
            back = _end(line, route.lines[:place][::-1], route.source, leaving)
            ahead = _end(line, route.lines[place + 1 :], route.target, entering)
            low, high = sorted((back, ahead))
            runs.setdefault(line, {})[number] = low, high
    return {line: _ordered(there) for line, there in runs.items()}


def _end(line: Line, rest: Sequence[Line], spot: Spot, offset: float) -> End:
    """Return where a run along a line ends, before the rest of its way to a box.

    It is told by rows or columns, and within these by the distance from the middle: what is between
    them has its size only when all tracks are known.
    """
    is_gap, number = line
    across, along = (spot.column, spot.row) if is_gap else (spot.row, spot.column)
    if rest:
        further = rest[1][1] - 0.5 if len(rest) > 1 else across
        return (rest[0][1] - 0.5) * _FAR, 1 if further > number - 0.5 else -1
    at = along * _FAR + (spot.y if is_gap else 0.0) + offset
    return at, 1 if across > number - 0.5 else -1


def _ordered(runs: dict[int, Run]) -> dict[int, int]:
    order = sorted(runs, key=lambda one: (sum(side for _, side in runs[one]), runs[one][0][0]))
    for _ in range(_ROUNDS):
        for place in range(len(order) - 1):
            one, other = order[place : place + 2]
            if _crossings(runs[other], runs[one]) < _crossings(runs[one], runs[other]):
                order[place : place + 2] = other, one
    found: dict[int, int] = {}
    for one in order:
        (low, _), (high, _) = runs[one]
        beside = [found[it] for it in found if runs[it][0][0] <= high and low <= runs[it][1][0]]
        found[one] = max(beside, default=-1) + 1
    return found


def _crossings(lower: Run, upper: Run) -> int:
    """Return how often two runs cross if one of them has the lower track."""
    outward = sum(side > 0 and upper[0][0] <= at <= upper[1][0] for at, side in lower)
    return outward + sum(side < 0 and lower[0][0] <= at <= lower[1][0] for at, side in upper)
