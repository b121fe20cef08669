"""Polygons in the plan: what is inside, what a straight leg enters, what goes around a corner.

Lengths below `EPSILON` do not count: touching a polygon's edge is not entering it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import hypot

Corner = tuple[float, float]
Polygon = tuple[Corner, ...]

EPSILON = 1e-6
"""Metres. A thousandth of what a drone's position is known to, and far above rounding."""

_SHARP = 0.5
"""The sine of half an angle below which a corner is walked around in two points, not one."""


def tidy(corners: Sequence[Corner]) -> Polygon:
    """Drop corners that repeat the one before, the last that repeats the first included."""
    kept: list[Corner] = []
    for corner in corners:
        if not kept or _apart(corner, kept[-1]):
            kept.append(corner)
    while len(kept) > 1 and not _apart(kept[0], kept[-1]):
        kept.pop()
    return tuple(kept)


def _apart(a: Corner, b: Corner) -> bool:
    return hypot(a[0] - b[0], a[1] - b[1]) > EPSILON


def inside(point: Corner, polygon: Polygon) -> bool:
    """Say whether a point is inside a polygon, and not merely on its edge."""
    x, y = point
    within = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if _distance(point, (ax, ay), (bx, by)) <= EPSILON:
            return False
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            within = not within
    return within


def _distance(point: Corner, a: Corner, b: Corner) -> float:
    """From a point to the nearest of a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square if square else 0.0
    along = min(1.0, max(0.0, along))
    return hypot(point[0] - a[0] - along * dx, point[1] - a[1] - along * dy)


def enters(start: Corner, end: Corner, polygon: Polygon) -> bool:
    """Say whether a straight leg goes through a polygon's inside, be it ever so concave."""
    if _clear(start, end, polygon):
        return False
    # Wherever the leg meets the outline it may change sides: look once between any two such places.
    dx, dy = end[0] - start[0], end[1] - start[1]
    square = dx * dx + dy * dy
    places = [0.0, 1.0]
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        ex, ey = bx - ax, by - ay
        cross = dx * ey - dy * ex
        if cross:
            places.append(((ax - start[0]) * ey - (ay - start[1]) * ex) / cross)
        if square:  # a corner on the way, for edges that the leg runs along
            places.append(((ax - start[0]) * dx + (ay - start[1]) * dy) / square)
    places = sorted(place for place in places if 0.0 <= place <= 1.0)
    middles = [(a + b) / 2 for a, b in pairwise(places)]
    return any(inside((start[0] + m * dx, start[1] + m * dy), polygon) for m in middles)


def _clear(start: Corner, end: Corner, polygon: Polygon) -> bool:
    """Whether the leg is all to one side of the polygon: the common case, and the cheap one."""
    if len(polygon) < 3:
        return True
    for axis in (0, 1):
        values = [corner[axis] for corner in polygon]
        if max(start[axis], end[axis]) <= min(values) or min(start[axis], end[axis]) >= max(values):
            return True
    return False


def pushed_out(polygon: Polygon, margin: float) -> list[Corner]:
    """Return where to turn around each corner that sticks out, so far from both its edges.

    A shortest way turns nowhere else. A sharp corner is cut off square, in two points: one point
    that far from both edges would be far from the corner.
    """
    around = sum(
        a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True)
    )
    corners = polygon if around > 0 else polygon[::-1]  # the inside is to the left
    turns: list[Corner] = []
    for i, (x, y) in enumerate(corners):
        (ax, ay), (bx, by) = corners[i - 1], corners[(i + 1) % len(corners)]
        before, after = hypot(x - ax, y - ay), hypot(bx - x, by - y)
        ux, uy = (x - ax) / before, (y - ay) / before
        vx, vy = (bx - x) / after, (by - y) / after
        if ux * vy - uy * vx <= EPSILON and ux * vx + uy * vy > -1 + EPSILON:
            continue  # it goes straight on, or turns in
        half = (max(0.0, 1 - (ux * vx + uy * vy)) / 2) ** 0.5  # the cosine of half the angle
        sine = max(0.0, 1 - half * half) ** 0.5
        if sine < _SHARP:
            turns.append((x + margin * (uy + ux), y + margin * (-ux + uy)))
            turns.append((x + margin * (vy - vx), y + margin * (-vx - vy)))
        else:
            nx, ny = uy + vy, -ux - vx  # the sum of the edges' normals points out
            scale = margin / (sine * hypot(nx, ny))
            turns.append((x + nx * scale, y + ny * scale))
    return turns
