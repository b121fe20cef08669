"""Finding a place to land for a drone that cannot land where it is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil, cos, hypot, pi, sin
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point

_STEP = 0.25
"""Metres between the candidate places."""
_FURTHEST = 30.0
"""The radius of the search in metres: a map of kilometres would take too long."""


def free_spot(airspace: Airspace, point: Point, taken: Sequence[Point], apart: float) -> Point:
    """Return the nearest permitted place on the ground that is far enough from those taken.

    Where there is none anywhere near, straight below is as good as any.
    """
    return next(free_spots(airspace, point, taken, apart), (point[0], point[1], 0.0))


def free_spots(
    airspace: Airspace, point: Point, taken: Sequence[Point], apart: float
) -> Iterator[Point]:
    """Yield the permitted places on the ground that are far enough from those taken: near ones first."""
    width, depth = airspace.size
    for x, y in _around(point, min(_FURTHEST, hypot(width, depth))):
        if (
            0.0 <= x <= width
            and 0.0 <= y <= depth
            and airspace.problem((x, y, 0.0)) is None
            and is_free((x, y, 0.0), taken, apart)
        ):
            yield x, y, 0.0


def is_free(place: Point, taken: Sequence[Point], apart: float) -> bool:
    """Return whether a place on the ground is far enough from those taken."""
    x, y, _ = place
    return all(hypot(x - other[0], y - other[1]) >= apart for other in taken)


def _around(point: Point, furthest: float) -> Iterator[tuple[float, float]]:
    """Yield a place, and then places on wider and wider circles around it."""
    x, y, _ = point
    yield x, y
    for ring in range(1, ceil(furthest / _STEP) + 1):
        radius, places = ring * _STEP, 6 * ring
        for place in range(places):
            angle = 2 * pi * place / places
            yield x + radius * cos(angle), y + radius * sin(angle)
