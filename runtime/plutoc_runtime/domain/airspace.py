"""The map: its bounds, its no-fly areas, and the way around them.

Lengths below `EPSILON` do not count: touching an area's edge is not entering it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from heapq import heappop, heappush
from itertools import pairwise
from math import dist, inf
from typing import TYPE_CHECKING

from .errors import Failure, FlightFailed
from .text import number, place

if TYPE_CHECKING:
    from .model import Point

Corner = tuple[float, float]
Polygon = tuple[Corner, ...]
Way = tuple["Point", ...]

MARGIN = 0.1  # how far from the corner of a no-fly area a route turns, in metres

EPSILON = 1e-6
"""Metres. A thousandth of what a drone's position is known to, and far above rounding."""

_SHARP = 0.5
"""The sine of half an angle below which a corner is walked around in two points, not one."""

_REMEMBERED = 10_000
"""Routes and places kept: plans repeat theirs, but a drone may be asked from anywhere."""


@dataclass(frozen=True, kw_only=True)
class Airspace:
    """A rectangle from (0, 0), in metres, less the polygons that no drone may enter."""

    size: tuple[float, float] = (20.0, 20.0)
    cruise_height: float = 1.2
    ceiling: float = 10.0
    no_fly: tuple[Polygon, ...] = ()

    @cached_property
    def problem(self) -> Callable[[Point], str | None]:
        """Return why a drone may not be at a point, or None."""
        return lru_cache(_REMEMBERED)(self._problem)

    def _problem(self, point: Point) -> str | None:
        x, y, z = point
        width, depth = self.size
        e = EPSILON
        if not (-e <= x <= width + e and -e <= y <= depth + e):
            bounds = f"x goes from 0 to {number(width)} m, y from 0 to {number(depth)} m"
            return f"{place(point)} is outside the map: {bounds}"
        if not -e <= z <= self.ceiling + e:
            where = f"{place(point)} at a height of {number(z)} m"
            if z < 0:
                return f"{where} is below the ground"
            return f"{where} is above the ceiling of {number(self.ceiling)} m"
        for count, area in enumerate(self.areas, 1):
            if inside((x, y), area):
                return f"{place(point)} is inside no-fly area {count}"
        return None

    def within(self, point: Point) -> Point:
        """Return the point inside the map's bounds that is nearest: a measured place may be just outside."""
        x, y, z = point
        width, depth = self.size
        nearest = min(max(x, 0.0), width), min(max(y, 0.0), depth), min(max(z, 0.0), self.ceiling)
        return nearest if dist(point, nearest) > EPSILON else point

    def route(self, start: Point, end: Point) -> Way | None:
        """Return the shortest permitted route, with the end and without the start, or None.

        It is straight wherever it can be. Around corners its height changes evenly along the way.
        """
        if not self.areas:
            return None if self.problem(start) or self.problem(end) else (end,)
        way = self._ways(min(start, end), max(start, end))  # one way for both directions
        if way is None:
            return None
        return way[1:] if start <= end else way[-2::-1]

    @cached_property
    def areas(self) -> tuple[Polygon, ...]:
        """The no-fly areas, without corners that repeat."""
        return tuple(map(tidy, self.no_fly))

    @cached_property
    def _turns(self) -> list[Corner]:
        """The points at which a way around the areas may turn."""
        turns = [turn for area in self.areas if len(area) > 2 for turn in pushed_out(area, MARGIN)]
        return [(x, y) for x, y in turns if not self.problem((x, y, 0.0))]

    @cached_property
    def _ways(self) -> Callable[[Point, Point], Way | None]:
        return lru_cache(_REMEMBERED)(self._find)

    def _find(self, start: Point, end: Point) -> Way | None:
        """Return the shortest route with both its ends."""
        if self.problem(start) or self.problem(end):
            return None
        if self._free(start[:2], end[:2]):
            return start, end
        corners = self._shortest(start[:2], end[:2])
        return None if corners is None else _climbing(start, corners, end)

    def _free(self, a: Corner, b: Corner) -> bool:
        return not any(enters(a, b, area) for area in self.areas)

    def _shortest(self, start: Corner, end: Corner) -> tuple[Corner, ...] | None:
        """Search with A* over the turns; of equally short routes the first found."""
        spots = [*self._turns, end, start]
        last, first = len(spots) - 2, len(spots) - 1
        best = {first: 0.0}
        heap: list[tuple[float, int, float, tuple[Corner, ...]]] = [(0.0, first, 0.0, ())]
        while heap:
            _, here, gone, corners = heappop(heap)
            if here == last:
                return corners
            if gone > best[here]:
                continue  # a shorter way has been found since
            passed = corners if here == first else (*corners, spots[here])
            for there, spot in enumerate(spots):
                length = gone + dist(spots[here], spot)
                if length < best.get(there, inf) and self._free(spots[here], spot):
                    best[there] = length
                    heappush(heap, (length + dist(spot, end), there, length, passed))
        return None


def _climbing(start: Point, corners: tuple[Corner, ...], end: Point) -> tuple[Point, ...]:
    """Add heights to a way: the shortest in the plan is then the shortest in space."""
    plan = [start[:2], *corners, end[:2]]
    legs = [dist(a, b) for a, b in pairwise(plan)]
    whole, gone, way = sum(legs), 0.0, [start]
    for (x, y), leg in zip(corners, legs, strict=False):
        gone += leg
        way.append((x, y, start[2] + (end[2] - start[2]) * gone / whole))
    return *way, end


def permitted_way(airspace: Airspace, drone: str, start: Point, end: Point) -> tuple[Point, ...]:
    """Return the points to fly through, the end included; raise `FlightFailed` if there is no way."""
    route = airspace.route(start, end)
    if route is None:
        raise FlightFailed(
            Failure.REFUSED, f"there is no permitted way from {drone} to {place(end)}"
        )
    return route


# Polygons in the plan


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


def distance(point: Corner, a: Corner, b: Corner) -> float:
    """Return the distance of a point from a straight leg."""
    return dist(point, nearest(point, a, b))


def nearest(point: Corner, a: Corner, b: Corner) -> Corner:
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
