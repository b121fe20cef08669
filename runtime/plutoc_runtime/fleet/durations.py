"""How long flights take, about: by the bounds of what they take of a battery, without a look at the map."""

from __future__ import annotations

from math import dist
from typing import TYPE_CHECKING

from ..domain.status import DroneStatus
from ..time.kernel import FLEET, EventKind, Timer
from .reach import chain_of

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Point
    from .queue import Queue, Request

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
    chain = chain_of(request.trips)
    here = request.goal
    way = 0.0
    for trip in chain:
        way += dist(here[:2], trip.target[:2])
        here = trip.target
    return len(chain) * upright(category, request) + way * pace(category, request)


def free_again(drone: Drone, queue: Queue) -> tuple[float, Point]:
    """Return in about how many seconds a drone is free again, and where it is then."""
    if drone.status is DroneStatus.RETURNING and drone in queue.homeward:
        motion = drone.category.motion
        speed = drone.category.speed
        way = motion.flies(dist(drone.location[:2], drone.home[:2]), speed)
        return way + motion.lands(abs(drone.location[2] - drone.home[2]), speed), drone.home
    now = queue.kernel.now
    then, place = queue.plans["until"].get(drone, (now, drone.location))
    then = queue.ready_at(drone) or then
    if drone.status is DroneStatus.FREE or then < now:
        place = drone.location
    # one that is late will take as long again as it is late by now, for all one knows
    return abs(then - now), place


def look_again(queue: Queue, key: object, seconds: float) -> None:
    """Serve the queue again in so many seconds: a drone may be late, and nothing else happens."""
    kernel = queue.kernel
    queue.plans.pop(key, Timer(int)).cancel()
    queue.plans[key] = kernel.at(kernel.now + seconds, EventKind.CLOCK, FLEET, queue.changed)
