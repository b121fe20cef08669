"""The places from which an area is covered, and the order in which they are flown to.

The area, less what may not be flown over, is cut into cells no larger than what is covered from one place. Each cell
gets one place, from which all of the area that is in it is covered; where a no-fly area leaves no such place, it gets
more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from math import ceil, floor
from typing import Any

import shapely
from shapely.geometry import LineString, Polygon, box
from shapely.ops import nearest_points

from ..shared.domain.airspace import Airspace, Corner
from ..shared.domain.text import place
from .cells import ordered

MOST = 2_000
"""The most places of one area."""

Sides = tuple[float, float]
"""Of the rectangle around a place that is covered from there, along x and along y, in metres."""
Covered = Callable[[bool], Sides]
"""What is covered from a place, if the lanes lead along x, and if they do not."""

_TINY = 1e-9
"""Square metres, and metres, that come of rounding."""
_DIGITS = 6
"""A place is told to a micrometre, which is within what the map takes for its edge."""


_VALID = "Valid Geometry"


class TooManyPlaces(ValueError):
    """The places are too near to each other for an area of this size."""


@dataclass(frozen=True, slots=True)
class Sweep:
    """How an area is flown."""

    lanes: Sequence[Sequence[Corner]]
    """The places of each lane, in the order in which they are flown to; empty: none of the area may be flown over."""
    forbidden: float
    """The share of the area that may not be flown over."""
    field: Any
    """What is of the area, and how far places may lie beside it."""

    @property
    def places(self) -> Sequence[Corner]:
        """All places, in the order in which they are flown to."""
        return [*chain.from_iterable(self.lanes)]

    def outside(self, way: Sequence[Corner]) -> float:
        """Return how many metres of a way are not over the area."""
        return _outside(self.field, way)


def problem_of(corners: Sequence[Corner]) -> str | None:
    """Return what is wrong with an outline, or None."""
    if len(corners) < 3 or Polygon(corners).convex_hull.area <= _TINY:
        return "covers no ground: an area has three corners [x, y], not on one line"
    found = shapely.is_valid_reason(Polygon(corners))
    if found == _VALID:
        return None
    x, y = map(float, found.rpartition("[")[2].rstrip("]").split())
    return f"crosses or touches itself near {place((x, y, 0.0))}: name the corners in their order around it"


def sweep(
    corners: Sequence[Corner],
    covered: Covered,
    airspace: Airspace,
    before: Corner | None,
    *,
    over_edges: bool = False,
) -> Sweep:
    """Return the places for an area, swept back and forth along its longer side.

    `before`: where the drones come from, if that is known. With `over_edges` a place may lie a little outside the area,
    so that a lane is straight. Raises `TooManyPlaces`.
    """
    whole = Polygon(corners)
    allowed = _permitted(whole, airspace)
    forbidden = 1.0 - sum(part.area for part in allowed) / whole.area
    if not allowed:
        return Sweep((), 1.0, whole)
    shape = shapely.union_all(allowed)
    x, y, most_x, most_y = shape.bounds
    is_wide = most_x - x >= most_y - y
    sides = covered(is_wide)
    if any(_least(part, sides) > MOST for part in allowed):
        raise TooManyPlaces
    grid = _Grid(shape, is_wide, sides, airspace if over_edges else None)
    lanes: list[list[Corner]] = []
    count = 0
    for lane in grid.lanes():
        lanes.append(lane)
        count += len(lane)
        if count > MOST:
            raise TooManyPlaces
    along, side = (0, sides[0]) if is_wide else (1, sides[1])
    field = whole.buffer(max(sides) / 2) if over_edges else whole
    shapely.prepare(field)
    made = [lane for lane in lanes if lane]
    flown = ordered(made, along, side, before, lambda way: _outside(field, way))
    return Sweep(flown, max(0.0, forbidden), field)


def _outside(field: Any, way: Sequence[Corner]) -> float:
    legs = (LineString(leg) for leg in pairwise(way))
    return sum(float(leg.difference(field).length) for leg in legs if not field.covers(leg))


def _permitted(area: Any, airspace: Airspace) -> list[Any]:
    """Return the parts of an area that may be flown over."""
    width, depth = airspace.size
    closed = [shapely.make_valid(Polygon(one)) for one in airspace.areas if len(one) > 2]
    left = area.intersection(box(0.0, 0.0, width, depth)).difference(shapely.union_all(closed))
    return _parts(left)


def _parts(shape: Any) -> list[Any]:
    """Return the polygons of a shape, without what has no width."""
    return [
        part
        for part in shapely.get_parts(shape)
        if part.geom_type == "Polygon" and part.area > _TINY
    ]


def _least(part: Any, sides: Sides) -> float:
    """Return how many places a connected part takes at least."""
    x, y, most_x, most_y = part.bounds
    wide, deep = sides
    least: float = max(part.area / (wide * deep), (most_x - x) / wide, (most_y - y) / deep)
    return least


class _Grid:
    """The cells of an area: lanes along its longer side, each cut into cells of one size."""

    def __init__(
        self, allowed: Any, is_wide: bool, sides: Sides, over_edges: Airspace | None
    ) -> None:
        """`over_edges`: of the map on which places may lie outside the area; None: they may not."""
        self._allowed = allowed
        self._is_wide = is_wide
        self._wide, self._deep = sides
        self._over_edges = over_edges
        shapely.prepare(allowed)
        self._x, self._y, most_x, most_y = allowed.bounds
        self._cell_x = _even(most_x - self._x, self._wide)
        self._cell_y = _even(most_y - self._y, self._deep)

    def lanes(self) -> Iterator[list[Corner]]:
        """Yield the places of each lane, in order along it."""
        along, across = (0, 1) if self._is_wide else (1, 0)
        for lane in self._touched(self._allowed, across):
            part = self._allowed.intersection(self._strip(lane, across))
            places: list[Corner] = []
            for number in self._touched(part, along):
                column, row = (number, lane) if self._is_wide else (lane, number)
                places += self._places(part, column, row)
            yield sorted(places, key=lambda spot: (spot[along], spot[across]))

    def _touched(self, shape: Any, axis: int) -> list[int]:
        """Return which lanes, or cells of a lane, a shape reaches."""
        start, side = ((self._x, self._cell_x), (self._y, self._cell_y))[axis]
        found: set[int] = set()
        for part in _parts(shape):
            first = floor((part.bounds[axis] - start) / side + _TINY)
            last = ceil((part.bounds[axis + 2] - start) / side - _TINY)
            found.update(range(max(0, first), last))
        return sorted(found)

    def _strip(self, lane: int, across: int) -> Any:
        x, y, most_x, most_y = self._allowed.bounds
        if across:
            return box(
                x, self._y + lane * self._cell_y, most_x, self._y + (lane + 1) * self._cell_y
            )
        return box(self._x + lane * self._cell_x, y, self._x + (lane + 1) * self._cell_x, most_y)

    def _places(self, part: Any, column: int, row: int) -> Iterator[Corner]:
        """Yield the places of one cell: one, wherever that is enough."""
        x, y = self._x + column * self._cell_x, self._y + row * self._cell_y
        cell = box(x, y, x + self._cell_x, y + self._cell_y)
        if self._allowed.covers(cell) or self._is_over_edge(cell):  # most are, and this is fast
            yield round(cell.centroid.x, _DIGITS) + 0.0, round(cell.centroid.y, _DIGITS) + 0.0
            return
        rest = shapely.union_all(_parts(part.intersection(cell)))
        if rest.is_empty:
            return
        spot = self._nearest(rest, cell)
        yield spot
        for quarter in _quarters(cell):  # from any place in one, all of it is covered
            rest = shapely.union_all(_parts(rest.difference(self._seen(spot))))
            inside = shapely.union_all(_parts(rest.intersection(quarter)))
            if not inside.is_empty:
                spot = self._nearest(inside, quarter)
                yield spot

    def _is_over_edge(self, cell: Any) -> bool:
        """Return whether the place of a cell may be its middle, wherever the area's edge is."""
        if self._over_edges is None:
            return False
        x = cell.centroid.x
        y = cell.centroid.y
        return self._over_edges.problem((x, y, self._over_edges.cruise_height)) is None

    def _nearest(self, shape: Any, cell: Any) -> Corner:
        """Return the place of a shape nearest to the middle of its cell, if there is one, from which all of it is seen."""
        x, y, most_x, most_y = shape.bounds
        across = self._wide / 2 + _TINY
        up = self._deep / 2 + _TINY
        middle = cell.centroid
        from_there = box(most_x - across, most_y - up, x + across, y + up)
        best = shape.intersection(from_there)
        found, _ = nearest_points(shape if best.is_empty else best, middle)
        return round(found.x, _DIGITS) + 0.0, round(found.y, _DIGITS) + 0.0

    def _seen(self, spot: Corner) -> Any:
        x, y = spot
        return box(x - self._wide / 2, y - self._deep / 2, x + self._wide / 2, y + self._deep / 2)


def _even(side: float, spacing: float) -> float:
    """Return the side of the cells of which a whole number make up a side."""
    return side / max(1, ceil(side / spacing - _TINY))


def _quarters(cell: Any) -> Iterator[Any]:
    x, y, most_x, most_y = cell.bounds
    middle = cell.centroid
    for across in ((x, middle.x), (middle.x, most_x)):
        for up in ((y, middle.y), (middle.y, most_y)):
            yield box(across[0], up[0], across[1], up[1])
