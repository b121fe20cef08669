"""Where no drone may be, seen while it flies: a little further than where none is sent."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plutoc_runtime.domain.geometry import Polygon, distance, inside, tidy
from plutoc_runtime.domain.text import number, place

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point

TOLERANCE = 0.3
"""Metres: positions are not exact, and a drone that is stopped goes on for a moment."""


def strayed(airspace: Airspace, point: Point) -> str | None:
    """Return where a drone is that has left the permitted area, or None."""
    (x, y, z), (width, depth) = point, airspace.size
    if not (-TOLERANCE <= x <= width + TOLERANCE and -TOLERANCE <= y <= depth + TOLERANCE):
        return f"{place(point)}, which is outside the map"
    if z > airspace.ceiling + TOLERANCE:
        return f"{place(point)}, {number(z)} m high"
    if z < -TOLERANCE:
        return f"{place(point)}, {number(-z)} m below the ground"
    for count, corners in enumerate(airspace.no_fly, 1):
        if is_deep_inside((x, y), tidy(corners)):
            return f"{place(point)}, which is inside no-fly area {count}"
    return None


def is_over_no_fly(airspace: Airspace, point: Point) -> bool:
    """Say whether a drone there must not come straight down."""
    areas = (tidy(corners) for corners in airspace.no_fly)
    return any(len(area) > 2 and inside(point[:2], area) for area in areas)


def is_deep_inside(point: tuple[float, float], area: Polygon) -> bool:
    """Say whether a point is further inside than the tolerance, or halfway into a narrow area."""
    if len(area) < 3 or not inside(point, area):
        return False
    edges = list(zip(area, area[1:] + area[:1], strict=True))
    around = sum(distance(a, b, b) for a, b in edges)
    twice = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges))
    # The widest circle in an area is about as wide as twice its surface by its outline.
    within = min(TOLERANCE, twice / 2 / around)
    return all(distance(point, a, b) > within for a, b in edges)
