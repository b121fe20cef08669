"""How long flights take, about: by the bounds of what they take of a battery, without a look at the map."""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

from ..domain.status import DroneStatus
from ..time.kernel import FLEET, EventKind, Timer
from .reach import chain_of

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Point
    from .needs import Request
    from .queue import Queue

FLIES = (DroneStatus.FREE, DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.CHARGING)


def ends(request: Request) -> Point:
    """Return where a drone is when it has flown what one drone must fly."""
    return chain_of(request.trips)[-1].target


def pace(category: Category, request: Request) -> float:
    """Return about how many seconds a metre takes."""
    return category.endurance * request.takes(category)[1]


def upright(category: Category, request: Request) -> float:
    """Return about how many seconds take-off, action and landing take."""
    return category.endurance * (request.takes(category)[0] - category.reserve)


def busy(category: Category, request: Request) -> float:
    """Return about how many seconds a flight takes beside the way to where it begins.

    From a pick on that is all that follows up to its release.
    """
    chain, here, way = chain_of(request.trips), request.goal, 0.0
    for trip in chain:
        there = trip.target
        way, here = way + hypot(here[0] - there[0], here[1] - there[1]), there
    return len(chain) * upright(category, request) + way * pace(category, request)


def free_again(drone: Drone, queue: Queue) -> tuple[float, Point]:
    """Return in about how many seconds a drone is free again, and where it is then."""
    if drone.status is DroneStatus.RETURNING and drone in queue.homeward:
        return _home_in(drone), drone.home
    now = queue.kernel.now
    then, place = queue.plans["until"].get(drone, (now, drone.location))
    if drone in queue.low and queue.low[drone][0] < inf:
        then = queue.low[drone][0]
    if drone.status is DroneStatus.FREE or then < now:
        place = drone.location
    # one that is late will take as long again as it is late by now, for all one knows
    return abs(then - now), place


def _home_in(drone: Drone) -> float:
    """Return in about how many seconds a drone that flies home has landed there."""
    kind = drone.category
    (x, y, z), (home_x, home_y, ground) = drone.location, drone.home
    way = kind.motion.flies(hypot(home_x - x, home_y - y), kind.speed)
    return way + kind.motion.lands(abs(z - ground), kind.speed)


def look_again(queue: Queue, key: object, seconds: float) -> None:
    """Serve the queue again in so many seconds: a drone may be late, and nothing else happens."""
    plans, kernel = queue.plans, queue.kernel
    plans.pop(key, Timer(int)).cancel()
    plans[key] = kernel.at(kernel.now + seconds, EventKind.CLOCK, FLEET, queue.changed)
