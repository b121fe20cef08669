"""Polygons in the plan: what is inside, what a straight leg enters, what goes around a corner.

Lengths below `EPSILON` do not count: touching a polygon's edge is not entering it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import dist

Corner = tuple[float, float]
Polygon = tuple[Corner, ...]

EPSILON = 1e-6
"""Metres. A thousandth of what a drone's position is known to, and far above rounding."""

_SHARP = 0.5
"""The sine of half an angle below which a corner is walked around in two points, not one."""


def covers_ground(corners: Sequence[Corner]) -> bool:
    """Return whether these corners enclose an area, and are not all on one line."""
    return abs(_turning(corners)) >= 1e-9


def _turning(corners: Sequence[Corner]) -> float:
    """Return twice the area that corners enclose; negative if they go around clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in _edges(corners))


def _edges(corners: Sequence[Corner]) -> Iterable[tuple[Corner, Corner]]:
    return pairwise([*corners, *corners[:1]])


def tidy(corners: Sequence[Corner]) -> Polygon:
    """Drop corners that repeat the one before, the last that repeats the first included."""
    kept: list[Corner] = []
    for corner in corners:
        if not kept or dist(corner, kept[-1]) > EPSILON:
            kept.append(corner)
    while len(kept) > 1 and dist(kept[0], kept[-1]) <= EPSILON:
        kept.pop()
    return tuple(kept)


def inside(point: Corner, polygon: Polygon) -> bool:
    """Return whether a point is inside a polygon, and not merely on its edge."""
    x, y = point
    within = False
    for (ax, ay), (bx, by) in _edges(polygon):
        if distance(point, (ax, ay), (bx, by)) <= EPSILON:
            return False
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            within = not within
    return within


def edge_points(point: Corner, polygon: Polygon, margin: float) -> list[Corner]:
    """Return the points of all edges that are nearest to a point inside, moved out by a margin."""
    found: list[Corner] = []
    for a, b in _edges(polygon):
        x, y = _nearest(point, a, b)
        far = dist((x, y), point)
        scale = margin / far if far else 0.0
        found.append((x + (x - point[0]) * scale, y + (y - point[1]) * scale))
    return found


def distance(point: Corner, a: Corner, b: Corner) -> float:
    """Return the distance of a point from a straight leg."""
    return dist(point, _nearest(point, a, b))


def _nearest(point: Corner, a: Corner, b: Corner) -> Corner:
    """Return the point of a straight leg that is nearest to another point."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square if square else 0.0
    along = min(1.0, max(0.0, along))
    return a[0] + along * dx, a[1] + along * dy


def enters(start: Corner, end: Corner, polygon: Polygon) -> bool:
    """Return whether a straight leg crosses the inside of a polygon, concave ones included."""
    (x, y), dx, dy = start, end[0] - start[0], end[1] - start[1]
    square = dx * dx + dy * dy
    if len(polygon) < 3 or not square:
        return inside(start, polygon)
    beside = [dx * (cy - y) - dy * (cx - x) for cx, cy in polygon]
    along = [(dx * (cx - x) + dy * (cy - y)) / square for cx, cy in polygon]
    if min(beside) >= 0 or max(beside) <= 0 or min(along) >= 1 or max(along) <= 0:
        return False  # as most legs: all corners are on one side of it, or beyond an end
    # Wherever the leg meets the outline it may change sides: look once between any two such places.
    places = [0.0, 1.0, *along]  # a corner on the way counts, for edges that the leg runs along
    for (ax, ay), (bx, by) in _edges(polygon):
        cross = dx * (by - ay) - dy * (bx - ax)
        if cross:
            places.append(((ax - x) * (by - ay) - (ay - y) * (bx - ax)) / cross)
    places = sorted(place for place in places if 0.0 <= place <= 1.0)
    middles = [(a + b) / 2 for a, b in pairwise(places)]
    return any(inside((x + m * dx, y + m * dy), polygon) for m in middles)


def pushed_out(polygon: Polygon, margin: float) -> list[Corner]:
    """Return where to turn around each corner that sticks out, so far from both its edges.

    A shortest way turns nowhere else. A sharp corner is cut off square, in two points: one point
    that far from both edges would be far from the corner.
    """
    around = polygon if _turning(polygon) > 0 else polygon[::-1]  # the inside is to the left
    corners = [complex(x, y) for x, y in around]
    turns: list[complex] = []
    for i, corner in enumerate(corners):
        before, after = corner - corners[i - 1], corners[(i + 1) % len(corners)] - corner
        u, v = before / abs(before), after / abs(after)
        turn = u.conjugate() * v
        if turn.imag <= EPSILON and turn.real > -1 + EPSILON:
            continue  # it goes straight on, or turns in
        sine = abs(u + v) / 2  # of half the angle
        if sine < _SHARP:
            turns += [corner + margin * (u - 1j * u), corner - margin * (v + 1j * v)]
        else:
            turns.append(corner - 1j * (u + v) * margin / (2 * sine * sine))
    return [(turn.real, turn.imag) for turn in turns]
