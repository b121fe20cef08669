"""Why a mission waits for a drone, and which free drone is ready, from the allocation's data.

Only what the queue has computed already is used, as searching routes would delay the flight.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from math import ceil, floor
from typing import TYPE_CHECKING

from plutoc_runtime.domain.status import DroneStatus
from plutoc_runtime.domain.text import percent

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Drone, Trip
    from plutoc_runtime.fleet.fleet import Fleet
    from plutoc_runtime.fleet.queue import Request

LOOK_EVERY = 3.0
"""Seconds after which a reason is updated."""
MISSIONS_A_LOOK = 10
"""The most missions whose reasons are updated in one sample: there may be hundreds."""

_DOES = {
    DroneStatus.BUSY: "flying",
    DroneStatus.RETURNING: "coming home",
    DroneStatus.CHARGING: "charging",
    DroneStatus.RECOVERING: "recovering",
    DroneStatus.OFFLINE: "not asked yet",
}


class WaitReasons:
    """The reasons of waiting missions, cached between updates."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._looked = -LOOK_EVERY
        self._requests: dict[int, Request] = {}
        self._low: set[Drone] = set()
        self._known: dict[int, tuple[float, str]] = {}
        self._left = MISSIONS_A_LOOK

    def look(self, fleet: Fleet) -> None:
        """Begin a sample of all missions and drones."""
        now, self._left = self._clock(), MISSIONS_A_LOOK
        if now - self._looked >= LOOK_EVERY:
            self._looked = now
            self._requests = {id(request.trip): request for request in fleet.queue.waiters()}
            self._low = set(fleet.queue.too_low())
            self._known = {
                trip: said for trip, said in self._known.items() if trip in self._requests
            }

    def why(self, fleet: Fleet, trip: Trip) -> str:
        """Return why no drone flies a trip yet; empty: not known yet."""
        now = self._clock()
        since, said = self._known.get(id(trip), (-LOOK_EVERY, ""))
        request = self._requests.get(id(trip))
        if request is not None and self._left and now - since >= LOOK_EVERY:
            self._left -= 1
            said = why_no_drone(fleet, request)
            self._known[id(trip)] = now, said
        return said

    def why_low(self, fleet: Fleet, drone: Drone) -> str:
        """Return why a free drone is not ready; empty: it is."""
        if drone.status is not DroneStatus.FREE:
            return ""
        if drone in self._low:
            return "its battery is too low for every trip that waits"
        return "its battery has little more than its reserve" if fleet.is_low(drone) else ""


def why_no_drone(fleet: Fleet, request: Request) -> str:
    """Return what keeps each drone of the fleet from flying a waiting trip."""
    queue, able = fleet.queue, 0
    low: list[tuple[float, float, float]] = []
    does: Counter[str] = Counter()
    cannot: Counter[str] = Counter()
    for drone in fleet.drones:
        if drone.status is DroneStatus.LOST:
            does["lost"] += 1
        elif drone in fleet.retired:
            does["retired"] += 1
        elif (reason := _never(request, drone, drone in queue.low)) is not None:
            cannot[reason] += 1
        elif drone in queue.low:
            level = request.level(drone)
            low.append((level - drone.battery_level, drone.battery_level, level))
        elif drone.status is DroneStatus.FREE:
            able += 1
        else:
            does[_DOES[drone.status]] += 1
    parts = [f"{number} {what}" for what, number in does.items()]
    if low:
        _, has, takes = min(low)
        enough = f"it takes {percent(ceil(takes * 100) / 100)}"
        nearest = f"the nearest has {percent(floor(has * 100) / 100)}"
        needs = f": {enough}, {nearest}" if takes <= 1 else ""
        parts.insert(0, f"{len(low)} free, but too low{needs}")
    if able:
        parts.insert(0, f"{able} free" + ("" if queue.room else ", but no more may fly at once"))
    parts += [f"{number} cannot: {reason}" for reason, number in cannot.items()]
    return "; ".join(parts)


def _never(request: Request, drone: Drone, is_known: bool) -> str | None:
    """Return why a drone can never fly it, as far as known."""
    category, trip = drone.category, request.trip
    if is_known or not category.can(trip.action):
        return request.never(drone)
    heavy = trip.item is not None and trip.item.mass > category.payload
    return request.never(drone) if heavy else None
