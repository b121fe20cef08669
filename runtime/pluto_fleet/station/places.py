"""What a point of the map is called."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist
from typing import TYPE_CHECKING

from ..shared.domain.airspace import EPSILON, distance, inside

if TYPE_CHECKING:
    from ..files.landmarks import Landmarks
    from ..shared.domain.airspace import Corner, Polygon

NEAR = 0.5
"""Metres within which a point is at a named place."""


def name_of(landmarks: Landmarks, point: Sequence[float]) -> str | None:
    """Return the name of the nearest place within half a metre, else of the smallest zone around a point.

    The edge of a zone belongs to it; heights do not count. None: the point has no name.
    """
    x, y = point[:2]
    near = [(dist(one.at[:2], (x, y)), one.name) for one in landmarks.places]
    metres, name = min(near, default=(NEAR + 1.0, ""))
    if metres <= NEAR:
        return name
    around = [zone for zone in landmarks.zones if _contains(zone.corners, (x, y))]
    smallest = min(around, key=lambda zone: _ground(zone.corners), default=None)
    return None if smallest is None else smallest.name


def _contains(corners: Polygon, point: Corner) -> bool:
    edges = zip(corners, (*corners[1:], corners[0]), strict=True)
    return inside(point, corners) or any(distance(point, a, b) <= EPSILON for a, b in edges)


def _ground(corners: Polygon) -> float:
    """Return how much ground a polygon covers, in square metres."""
    edges = zip(corners, (*corners[1:], corners[0]), strict=True)
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges)) / 2
