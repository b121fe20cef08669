"""Places beside a target, for an action whose place another drone has taken.

They lie on rings around it, at its height: a drone above another blows it about. Only where the map leaves none
of them, or all are taken, are there places above it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import atan2, cos, pi, sin
from typing import TYPE_CHECKING

from .legs import leg_problem

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Point
    from .ways import Section

FURTHEST = 2
"""How far a place may be from the target, in multiples of what keeps drones apart."""
_PARTS = 4
"""In how many rings that distance is divided: where only the edge of a place is taken, a nearer one will do."""
_PLACES = 12
"""On each ring, but for the one that keeps drones just apart from one at the target: six have room there."""
_ABOVE = 2
"""How many places there are above the target."""


def best_angle(way: tuple[Point, ...], holders: tuple[Point, ...] | None) -> float:
    """Return in which direction from a target a place is reached at best, by the way to the target.

    `holders`: the way of the drone that flies there to have it. Square to that a place is out of its way.
    """
    (ax, ay, _), (bx, by, _) = (holders or way)[-2:]
    return atan2(by - ay, bx - ax) + (pi / 2 if holders else pi)


def places_around(target: Point, step: float, airspace: Airspace, angle: float) -> list[Point]:
    """Return the places around a target, the nearest first; on each ring one is in this direction."""
    found: list[Point] = []
    x, y, z = target
    for ring in range(1, FURTHEST * _PARTS + 1):
        radius = ring * step / _PARTS
        places = _PLACES // 2 if ring == _PARTS else _PLACES
        for number in range(places):
            turned = angle + 2 * pi * number / places
            place = (x + radius * cos(turned), y + radius * sin(turned), z)
            if _is_permitted(airspace, target, place):
                found.append(place)
    return found


def places_above(target: Point, step: float, airspace: Airspace) -> Iterator[Point]:
    """Yield the places above a target, the lowest first."""
    x, y, z = target
    for count in range(1, _ABOVE + 1):
        place = (x, y, z + count * step)
        if airspace.problem(place) is None:
            yield place


def to_beside(section: Section, place: Point, airspace: Airspace) -> Section | None:
    """Return a section to a place beside its target; None: something forbidden is on the last leg.

    Only its last leg is another one: to search a route to each of many places takes too long.
    """
    *before, target = section.points
    if leg_problem(airspace, before[-1], place) is not None:
        return None
    return replace(section, points=(*before, place), target=target)


def _is_permitted(airspace: Airspace, target: Point, place: Point) -> bool:
    """Whether a drone may be at a place, with nothing forbidden between it and the target."""
    return airspace.problem(place) is None and leg_problem(airspace, target, place) is None
