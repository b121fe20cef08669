"""Polygons in the plan: what is inside, what a straight leg enters, what goes around a corner.

Lengths below `EPSILON` do not count: touching a polygon's edge is not entering it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot

Corner = tuple[float, float]
Polygon = tuple[Corner, ...]

EPSILON = 1e-6
"""Metres. A thousandth of what a drone's position is known to, and far above rounding."""

_SHARP = 0.5
"""The sine of half an angle below which a corner is walked around in two points, not one."""


def covers_ground(corners: Sequence[Corner]) -> bool:
    """Return whether these corners enclose an area, and are not all on one line."""
    turns = pairwise([*corners, *corners[:1]])
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in turns)) >= 1e-9


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
    """Return whether a point is inside a polygon, and not merely on its edge."""
    x, y = point
    within = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if distance(point, (ax, ay), (bx, by)) <= EPSILON:
            return False
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            within = not within
    return within


def edge_points(point: Corner, polygon: Polygon, margin: float) -> list[Corner]:
    """Return the points of all edges that are nearest to a point inside, moved out by a margin."""
    found: list[Corner] = []
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        along = min(1.0, max(0.0, ((point[0] - ax) * dx + (point[1] - ay) * dy) / square))
        x, y = ax + along * dx, ay + along * dy
        far = hypot(x - point[0], y - point[1])
        scale = margin / far if far else 0.0
        found.append((x + (x - point[0]) * scale, y + (y - point[1]) * scale))
    return found


def distance(point: Corner, a: Corner, b: Corner) -> float:
    """Return the distance of a point from a straight leg."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square if square else 0.0
    along = min(1.0, max(0.0, along))
    return hypot(point[0] - a[0] - along * dx, point[1] - a[1] - along * dy)


@dataclass(frozen=True, slots=True)
class Area:
    """A polygon, and the rectangle around it: most legs are nowhere near."""

    corners: Polygon
    middle: Corner
    half: Corner


def outlined(corners: Sequence[Corner]) -> Area:
    """Return the area of an outline, its repeated corners left out."""
    outline = tidy(corners)
    xs, ys = [x for x, _ in outline] or [0.0], [y for _, y in outline] or [0.0]
    middle = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    return Area(outline, middle, ((max(xs) - min(xs)) / 2, (max(ys) - min(ys)) / 2))


def enters(start: Corner, end: Corner, area: Area) -> bool:
    """Return whether a straight leg crosses the inside of an area, concave ones included."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    if len(area.corners) < 3 or _passes_by(start, dx, dy, area):
        return False
    # Wherever the leg meets the outline it may change sides: look once between any two such places.
    square = dx * dx + dy * dy
    places = [0.0, 1.0]
    for (ax, ay), (bx, by) in zip(area.corners, area.corners[1:] + area.corners[:1], strict=True):
        ex, ey = bx - ax, by - ay
        cross = dx * ey - dy * ex
        if cross:
            places.append(((ax - start[0]) * ey - (ay - start[1]) * ex) / cross)
        if square:  # a corner on the way, for edges that the leg runs along
            places.append(((ax - start[0]) * dx + (ay - start[1]) * dy) / square)
    places = sorted(place for place in places if 0.0 <= place <= 1.0)
    middles = [(a + b) / 2 for a, b in pairwise(places)]
    return any(inside((start[0] + m * dx, start[1] + m * dy), area.corners) for m in middles)


def _passes_by(start: Corner, dx: float, dy: float, area: Area) -> bool:
    """Whether the rectangle around the area is all to one side of the leg, or beyond its ends."""
    (x, y), (width, height) = area.middle, area.half
    x, y = x - start[0], y - start[1]
    return (
        abs(dx * y - dy * x) >= abs(dx) * height + abs(dy) * width > 0
        or abs(x - dx / 2) >= width + abs(dx) / 2
        or abs(y - dy / 2) >= height + abs(dy) / 2
    )


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
