"""Ways home: straight, and over the others, steep or gently."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import dist, hypot
from typing import TYPE_CHECKING

from .detours import Section

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point

    from ..descent import Craft

_LEVELS = 9
"""How many heights are looked at, one above the other."""
_PARTS = (0.5, 0.25, 0.75)
"""At which part of a way it is farthest beside the straight one."""
_ASIDE = (0.6, -0.6, 1.2, -1.2)
"""So many metres; negative: to the right."""
_SLOPES = (4.0, 1.5, 0.0)
"""Metres forward for each metre up or down; 0: straight up, and straight down."""


def ways_home(
    airspace: Airspace, drone: Craft, here: Point, stands: bool, step: float
) -> list[Section]:
    """Return ways home that end on the ground; none where there is no way."""
    cruise, (x, y, _) = airspace.cruise_height, here
    start = (x, y, cruise) if stands else here
    end = (drone.home[0], drone.home[1], min(start[2], cruise))
    route = airspace.route(start, end)
    if route is None:
        return []
    ways = [(start, *route)]
    for level in range(_LEVELS):
        height = cruise + level * step
        if height <= airspace.ceiling + 1e-9:
            over = ((x, y, height), *((px, py, height) for px, py, _ in route))
            if len(route) == 1 and level:
                ways.append((start, _along(over[0], over[1], 0.5, 1.0), end))
            ways += [
                way for slope in _SLOPES if (way := _sloping(start, over, end, slope)) is not None
            ]
    if len(route) == 1:
        ways += _around(airspace, start, end)
    ground = (end[0], end[1], 0.0)
    return [Section(drone.id, _without_repeats((here, *way, ground)), stands, True) for way in ways]


def _around(airspace: Airspace, start: Point, end: Point) -> Iterator[tuple[Point, ...]]:
    """Yield ways to the left and to the right of the straight one."""
    (x, y, z), (dx, dy, dz) = start, (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    far = hypot(dx, dy)
    if not far:
        return
    for part in _PARTS:
        for aside in _ASIDE:
            turn = (
                x + part * dx - aside * dy / far,
                y + part * dy + aside * dx / far,
                z + part * dz,
            )
            if (
                airspace.problem(turn) is None
                and airspace.leg_problem(start, turn) is None
                and airspace.leg_problem(turn, end) is None
            ):
                yield start, turn, end


def _sloping(
    start: Point, over: tuple[Point, ...], end: Point, slope: float
) -> tuple[Point, ...] | None:
    """Return a way that rises, crosses, and sinks; None: it is too short for these slopes."""
    up, down = slope * abs(over[0][2] - start[2]), slope * abs(over[-1][2] - end[2])
    first, last = dist(over[0], over[1]), dist(over[-2], over[-1])
    if up > first or down > last or (len(over) == 2 and up + down > first):
        return None
    risen, sinks = _along(over[0], over[1], up, first), _along(over[-1], over[-2], down, last)
    return (start, risen, *over[1:-1], sinks, end)


def _along(a: Point, b: Point, metres: float, length: float) -> Point:
    part = metres / length if length else 0.0
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2]


def _without_repeats(points: tuple[Point, ...]) -> tuple[Point, ...]:
    return (points[0], *(b for a, b in pairwise(points) if a != b))
