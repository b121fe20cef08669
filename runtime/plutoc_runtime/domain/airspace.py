"""The map: its bounds, its no-fly areas, and the way around them."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import pairwise
from math import dist, inf
from typing import TYPE_CHECKING

from .errors import Failure, FlightFailed
from .geometry import EPSILON, Corner, edge_points, enters, inside, outlined, pushed_out
from .text import number, place

if TYPE_CHECKING:
    from .model import Point

MARGIN = 0.1
"""How far from the corner of a no-fly area a route turns, in metres."""

_REMEMBERED = 10_000
"""Routes and places kept: plans repeat theirs, but a drone may be asked from anywhere."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Airspace:
    """A rectangle from (0, 0), in metres, less the polygons that no drone may enter."""

    size: tuple[float, float] = (20.0, 20.0)
    cruise_height: float = 1.2
    ceiling: float = 10.0
    no_fly: tuple[tuple[Corner, ...], ...] = ()
    _ways: _Ways = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # Frozen, yet its routes are found only when they are asked for.
        object.__setattr__(self, "_ways", _Ways(self))

    def problem(self, point: Point) -> str | None:
        """Return why a drone may not be at this point, or None."""
        permitted = self._ways.permitted
        if point in permitted:
            return None
        problem = self._problem(point)
        if problem is None:
            if len(permitted) >= _REMEMBERED:
                permitted.clear()
            permitted.add(point)
        return problem

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
        for count, area in enumerate(self._ways.areas, 1):
            if inside((x, y), area.corners):
                return f"{place(point)} is inside no-fly area {count}"
        return None

    def leg_problem(self, start: Point, end: Point) -> str | None:
        """Return why no drone may fly straight from one permitted point to another, or None."""
        for count, area in enumerate(self._ways.areas, 1):
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
        for _ in range(1 + len(self._ways.areas)):
            area = next((one for one in self._ways.areas if inside((x, y), one.corners)), None)
            if area is None:
                break
            edges = [
                (px, py)
                for px, py in edge_points((x, y), area.corners, EPSILON)
                if not self.problem((px, py, z))
            ]
            if not edges:
                break
            x, y = min(edges, key=lambda edge: dist(edge, (x, y)))
        return x, y, z

    def route(self, start: Point, end: Point) -> tuple[Point, ...] | None:
        """Return the shortest permitted route, with the end and without the start, or None.

        It is straight wherever it can be. Around corners its height changes evenly along the way.
        """
        if start > end:  # one way for both directions
            back = self._ways.between(end, start)
            return None if back is None else back[-2::-1]
        way = self._ways.between(start, end)
        return None if way is None else way[1:]


class _Ways:
    """The visibility graph of the map, computed as it is needed."""

    def __init__(self, airspace: Airspace) -> None:
        self._airspace = airspace
        self.areas = tuple(map(outlined, airspace.no_fly))
        self._turns: tuple[Corner, ...] | None = None
        self._seen: dict[int, list[tuple[int, float]]] = {}
        self._found: dict[tuple[Point, Point], tuple[Point, ...] | None] = {}
        self.permitted: set[Point] = set()
        """Points that are known to be permitted."""

    def between(self, start: Point, end: Point) -> tuple[Point, ...] | None:
        """Return the shortest route with both its ends."""
        pair = start, end
        if pair not in self._found:
            if len(self._found) >= _REMEMBERED:
                self._found.clear()
            self._found[pair] = self._find(start, end)
        return self._found[pair]

    def _find(self, start: Point, end: Point) -> tuple[Point, ...] | None:
        if self._airspace.problem(start) or self._airspace.problem(end):
            return None
        if self._free(start[:2], end[:2]):
            return start, end
        corners = self._shortest(start[:2], end[:2])
        return None if corners is None else _climbing(start, corners, end)

    def _free(self, a: Corner, b: Corner) -> bool:
        return not any(enters(a, b, area) for area in self.areas)

    def _shortest(self, start: Corner, end: Corner) -> list[Corner] | None:
        """Search with A* over the corners; of equally short routes the first found."""
        turns = self._corners()
        last = len(turns)
        rest = [*(dist(turn, end) for turn in turns), 0.0]
        best = {i: dist(start, turn) for i, turn in enumerate(turns) if self._free(start, turn)}
        came_from: dict[int, int] = {}
        heap = sorted((length + rest[i], i) for i, length in best.items())
        done: set[int] = set()
        while heap:
            _, here = heappop(heap)
            if here == last:
                return _walk_back(came_from, last, turns)
            if here in done:
                continue
            done.add(here)
            onward = [*self._visible(here)]
            if self._free(turns[here], end):
                onward.append((last, rest[here]))
            for there, step in onward:
                if best[here] + step < best.get(there, inf):
                    best[there], came_from[there] = best[here] + step, here
                    heappush(heap, (best[there] + rest[there], there))
        return None

    def _corners(self) -> tuple[Corner, ...]:
        if self._turns is None:
            turns = [
                turn
                for area in self.areas
                if len(area.corners) > 2
                for turn in pushed_out(area.corners, MARGIN)
            ]
            self._turns = tuple((x, y) for x, y in turns if not self._airspace.problem((x, y, 0.0)))
        return self._turns

    def _visible(self, here: int) -> list[tuple[int, float]]:
        if here not in self._seen:
            turns = self._corners()
            self._seen[here] = [
                (i, dist(turns[here], turn))
                for i, turn in enumerate(turns)
                if i != here and self._free(turns[here], turn)
            ]
        return self._seen[here]


def _walk_back(came_from: dict[int, int], last: int, turns: tuple[Corner, ...]) -> list[Corner]:
    way = []
    while last in came_from:
        last = came_from[last]
        way.append(turns[last])
    return way[::-1]


def _climbing(start: Point, corners: list[Corner], end: Point) -> tuple[Point, ...]:
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
