"""What keeps drones from flying a trip that waits, as far as the queue has computed it already."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

from ..domain.status import DroneStatus

if TYPE_CHECKING:
    from ..domain.model import Drone
    from .fleet import Fleet
    from .queue import Request


def hindrances(fleet: Fleet, request: Request) -> dict[str, Any]:
    """Return how many drones are `free`, `retired`, busy by `status`, or `cannot` fly the trip, and why.

    `low`: for each free drone whose battery is too low, the level that it `needs` and `has`; `room`: whether
    one more may fly. No route is searched here, as that would delay the flight.
    """
    queue, free, retired = fleet.queue, 0, 0
    low: list[dict[str, float]] = []
    status: Counter[str] = Counter()
    cannot: Counter[str] = Counter()
    for drone in fleet.drones:
        if drone in fleet.retired and drone.status is not DroneStatus.LOST:
            retired += 1
        elif drone.status is not DroneStatus.LOST and (why := _never(request, drone, queue.low)):
            cannot[why] += 1
        elif drone in queue.low:
            low.append({"needs": request.level(drone), "has": drone.battery_level})
        elif drone.status is DroneStatus.FREE:
            free += 1
        else:
            status[drone.status.value] += 1
    counts = {"status": dict(status), "cannot": dict(cannot), "retired": retired}
    return {**counts, "free": free, "room": queue.room, "low": low}


def _never(request: Request, drone: Drone, known: Any) -> str | None:
    """Return why a drone can never fly it, as far as known."""
    category, trip = drone.category, request.trip
    if drone in known or not category.can(trip.action):
        return request.never(drone)
    heavy = trip.item is not None and trip.item.mass > category.payload
    return request.never(drone) if heavy else None
