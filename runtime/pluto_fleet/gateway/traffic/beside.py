"""Places beside a target, for an action whose place another drone has taken.

They lie on rings around it, at its height: a drone above another blows it about. Only where the map leaves none
of them, or all are taken, are there places above it.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, sin
from typing import TYPE_CHECKING

from .legs import leg_problem

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Point

FURTHEST = 2
"""How far a place may be from the target, in multiples of what keeps drones apart."""
_PARTS = 4
"""In how many rings that distance is divided: where only the edge of a place is taken, a nearer one will do."""
_PLACES = 12
"""On each ring; every second one is as far from the next as from the target."""
_ABOVE = 2
"""How many places there are above the target."""


def places_around(target: Point, step: float, airspace: Airspace) -> list[Point]:
    """Return the places around a target, the nearest first.

    On the ring on which drones keep apart from one at the target, every second place comes first: six find room there.
    """
    found: list[Point] = []
    x, y, z = target
    for ring in range(1, FURTHEST * _PARTS + 1):
        radius = ring * step / _PARTS
        for number in (*range(0, _PLACES, 2), *range(1, _PLACES, 2)):
            angle = 2 * pi * number / _PLACES
            place = (x + radius * cos(angle), y + radius * sin(angle), z)
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


def _is_permitted(airspace: Airspace, target: Point, place: Point) -> bool:
    """Whether a drone may be at a place, with nothing forbidden between it and the target."""
    return airspace.problem(place) is None and leg_problem(airspace, target, place) is None
