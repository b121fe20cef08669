"""The map: its bounds, its no-fly areas, and the way around them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from heapq import heappop, heappush
from itertools import pairwise
from math import dist, inf
from typing import TYPE_CHECKING

from .errors import Failure, FlightFailed
from .geometry import EPSILON, Corner, edge_points, enters, inside, pushed_out, tidy
from .text import number, place

if TYPE_CHECKING:
    from .model import Point

Way = tuple["Point", ...]

MARGIN = 0.1
"""How far from the corner of a no-fly area a route turns, in metres."""

_REMEMBERED = 10_000
"""Routes and places kept: plans repeat theirs, but a drone may be asked from anywhere."""


@dataclass(frozen=True, kw_only=True)
class Airspace:
    """A rectangle from (0, 0), in metres, less the polygons that no drone may enter."""

    size: tuple[float, float] = (20.0, 20.0)
    cruise_height: float = 1.2
    ceiling: float = 10.0
    no_fly: tuple[tuple[Corner, ...], ...] = ()

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
        for count, area in enumerate(self._areas, 1):
            if inside((x, y), area):
                return f"{place(point)} is inside no-fly area {count}"
        return None

    def leg_problem(self, start: Point, end: Point) -> str | None:
        """Return why no drone may fly straight from one permitted point to another, or None."""
        for count, area in enumerate(self._areas, 1):
            if enters(start[:2], end[:2], area):
                way = f"the straight way from {place(start)} to {place(end)}"
                return f"{way} leads through no-fly area {count}"
        return None

    def way_back(self, point: Point) -> Point:
        """Return the permitted point that is nearest to one that is not, or almost so."""
        width, depth = self.size
        x, y, z = point
        x, y = min(max(x, 0.0), width), min(max(y, 0.0), depth)
        z = min(max(z, 0.0), self.ceiling)
        for _ in range(1 + len(self._areas)):
            around = next((area for area in self._areas if inside((x, y), area)), ())
            out = edge_points((x, y), around, EPSILON)
            permitted = [(ex, ey) for ex, ey in out if not self.problem((ex, ey, z))]
            if not permitted:
                break
            x, y = min(permitted, key=lambda edge: dist(edge, (x, y)))
        return x, y, z

    def route(self, start: Point, end: Point) -> Way | None:
        """Return the shortest permitted route, with the end and without the start, or None.

        It is straight wherever it can be. Around corners its height changes evenly along the way.
        """
        if start > end:  # one way for both directions
            back = self._ways(end, start)
            return None if back is None else back[-2::-1]
        way = self._ways(start, end)
        return None if way is None else way[1:]

    @cached_property
    def _areas(self) -> tuple[tuple[Corner, ...], ...]:
        return tuple(map(tidy, self.no_fly))

    @cached_property
    def _turns(self) -> list[Corner]:
        """The points at which a way around the areas may turn."""
        turns = [turn for area in self._areas if len(area) > 2 for turn in pushed_out(area, MARGIN)]
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
        return not any(enters(a, b, area) for area in self._areas)

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


def way_from(airspace: Airspace, drone: str, start: Point, end: Point) -> tuple[Point, ...]:
    """Return such a route; one that begins outside the permitted area leads back in first."""
    if airspace.problem(start) is None or airspace.problem(end) is not None:
        return permitted_way(airspace, drone, start, end)
    back = airspace.way_back(start)
    return (back, *permitted_way(airspace, drone, back, end))
