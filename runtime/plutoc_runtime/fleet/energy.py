"""How long a flight takes and what it costs: one arithmetic for plan, allocation and simulation.

The ground is at height 0. A drone in the air drains its battery evenly, moving or not.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import dist, hypot, inf, isinf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.model import Category, Point

CLIMB_SPEED = 0.3
"""Metres a second, straight up and straight down."""

DOCK_REACH = 0.2
"""How near its home a drone must land to be charged there, in metres."""


def docked(landed_at: Point, home: Point) -> bool:
    """Say whether a drone that landed there stands in its dock."""
    if landed_at == home:
        return True
    return hypot(landed_at[0] - home[0], landed_at[1] - home[1]) <= DOCK_REACH


def flight_seconds(
    category: Category,
    airspace: Airspace,
    start: Point,
    points: Sequence[Point],
    action_seconds: float,
) -> float:
    """Return how long it takes to fly through all points and to do the actions on the way.

    A start on the ground (z = 0) counts the take-off to cruise height; a last point on the ground
    counts the landing there, from the height flown before. Infinite where no route leads.
    """
    seconds, here = action_seconds, start
    if points and start[2] <= 0:
        here = (start[0], start[1], airspace.cruise_height)
        seconds += here[2] / CLIMB_SPEED
    for i, point in enumerate(points, 1):
        there = point
        if i == len(points) and point[2] <= 0:
            there = (point[0], point[1], here[2])
            seconds += there[2] / CLIMB_SPEED
        way = airspace.route(here, there)
        if way is None:
            return inf
        seconds += length(here, way) / category.speed
        here = there
    return seconds


def length(start: Point, way: Sequence[Point]) -> float:
    """Return the metres of a way, from its start on."""
    return sum(dist(a, b) for a, b in zip((start, *way), way, strict=False))


def share(category: Category, seconds: float) -> float:
    """Return the share of a full battery that so much flying takes."""
    return seconds / category.flight_time


def needed(
    category: Category,
    airspace: Airspace,
    start: Point,
    stops: Sequence[tuple[Point, float]],
    home: Point,
) -> float | None:
    """Return the share of the battery for all stops, each with its action, and back home.

    None: no route leads there, or none home. The reserve is not in it.
    """
    points = [point for point, _ in stops]
    actions = sum(seconds for _, seconds in stops)
    ground = (home[0], home[1], 0.0)
    seconds = flight_seconds(category, airspace, start, [*points, ground], actions)
    return None if isinf(seconds) else share(category, seconds)
