"""The way back in for a drone that has drifted to where it may not be."""

from __future__ import annotations

from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING

from ...shared.domain.airspace import EPSILON, inside, nearest, permitted_way

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace, Corner, Polygon
    from ...shared.domain.model import Point


def way_from(airspace: Airspace, drone: str, start: Point, end: Point) -> tuple[Point, ...]:
    """Return the points to fly through; a route that begins where no drone may be leads back first.

    Raises `FlightFailed` if there is no way.
    """
    if airspace.problem(start) is None or airspace.problem(end) is not None:
        return permitted_way(airspace, drone, start, end)
    back = way_back(airspace, start)
    return (back, *permitted_way(airspace, drone, back, end))


def way_back(airspace: Airspace, point: Point) -> Point:
    """Return the permitted point that is nearest to one that is not, or almost so."""
    x, y, z = airspace.within(point)
    for _ in range(1 + len(airspace.areas)):
        around = next((area for area in airspace.areas if inside((x, y), area)), ())
        out = _edge_points((x, y), around)
        permitted = [(ex, ey) for ex, ey in out if not airspace.problem((ex, ey, z))]
        if not permitted:
            break
        x, y = min(permitted, key=lambda edge: dist(edge, (x, y)))
    return x, y, z


def _edge_points(point: Corner, polygon: Polygon) -> list[Corner]:
    """Return the points of all edges that are nearest to a point inside, moved just out."""
    found: list[Corner] = []
    for a, b in pairwise([*polygon, *polygon[:1]]):
        x, y = nearest(point, a, b)
        far = dist((x, y), point)
        scale = EPSILON / far if far else 0.0
        found.append((x + (x - point[0]) * scale, y + (y - point[1]) * scale))
    return found
