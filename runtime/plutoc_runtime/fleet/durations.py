"""How long flights take, about: by the bounds of what they take of a battery, without a look at the map."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from .reach import chain_of

if TYPE_CHECKING:
    from ..domain.model import Category, Point
    from .needs import Request


def ends(request: Request) -> Point:
    """Return where a drone is when it has flown what one drone must fly."""
    return chain_of(request.trips)[-1].target


def pace(category: Category, request: Request) -> float:
    """Return about how many seconds a metre takes."""
    return category.endurance * request.bounds[category][1]


def upright(category: Category, request: Request) -> float:
    """Return about how many seconds take-off, action and landing take."""
    return category.endurance * (request.bounds[category][0] - category.reserve)


def busy(category: Category, request: Request) -> float:
    """Return about how many seconds a flight takes beside the way to where it begins.

    From a pick on that is all that follows up to its release.
    """
    chain, here, way = chain_of(request.trips), request.goal, 0.0
    for trip in chain:
        there = trip.target
        way, here = way + hypot(here[0] - there[0], here[1] - there[1]), there
    return len(chain) * upright(category, request) + way * pace(category, request)
