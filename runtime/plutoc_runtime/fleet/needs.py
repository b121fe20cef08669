"""Requests for drones, and the battery level that each needs of a drone where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush, heapreplace
from math import hypot, inf
from typing import TYPE_CHECKING, Any

from ..domain.keeper import trips_of
from ..time.future import Future
from .reach import MORE, Reach, chain_of, docked, miss_of

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Mission, Point
    from .policies import Policy


class Request(Future["Drone"]):
    """A mission's request for a drone; as a future it is set to the drone that it gets."""

    __slots__ = (
        *("_levels", "bounds", "goal", "hurries", "mission", "policy", "rank", "reach", "since"),
        *("trip", "trips", "why"),
    )

    def __init__(
        self, reach: Reach, mission: Mission[Any], policy: Policy, rank: tuple[int, int]
    ) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.mission = mission
        self.trips = trips_of(mission)
        self.since = 0.0
        self.trip = trip = self.trips[0]
        # the rank: its priority, and minus the number of its arrival; the highest is served first
        self.policy, self.rank = policy, rank
        self.goal = trip.source or trip.target  # where its drone flies to first
        self.why = ""  # why its drone was chosen
        self.hurries = False  # its mission waits for a limited time only
        self.reach = reach
        seconds = reach.app.actions[trip.action].lasts(trip.parameters)
        straight = not (trip.source or trip.item)
        self.bounds = reach.bounds(trip.action, seconds, trip.target, straight)
        self._levels: dict[tuple[Category, Point, Point], float] = {}

    def able(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip now."""
        level, here = drone.telemetry.battery_level, drone.telemetry.location
        if here == drone.home:
            bounds = self.bounds[drone.category]
            if level >= bounds[3] or level >= self.at_least(drone, here) * MORE + bounds[2]:
                return True
        return level >= self.at_least(drone, here) and level >= self.level(drone)

    def at_least(self, drone: Drone, here: Point) -> float:
        """Return a lower bound of the level that a drone needs from here: the straight way there and home."""
        (x, y, _), (a, b, z), (c, d, _) = self.goal, here, drone.home
        upright, a_metre, _, _ = self.bounds[drone.category]
        level = a_metre * (hypot(x - a, y - b) + hypot(x - c, y - d))
        # not below 0 where it leads is not a number
        return max(0.0, upright + level if z <= 0.0 else level)

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with all that its battery will have; None: it can."""
        if self.ever(drone):
            final = drone.category.charge_time == inf and drone.telemetry.landed
            final = final and docked(drone.location, drone.home)
            return UNCHARGED if final and not self.able(drone) else None
        app, airspace, chain = self.reach.app, self.reach.airspace, chain_of(self.trips)
        miss = miss_of(app, airspace, drone.category, drone.home, chain)
        return miss and miss.reason

    def ever(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip with a full battery."""
        return self.bounds[drone.category][3] <= 1.0 or self._level(drone, drone.home) <= 1.0

    def level(self, drone: Drone) -> float:
        """Return the battery level that a drone needs from where it stands; infinite: it never suffices."""
        return self._level(drone, drone.location) if self.ever(drone) else inf

    def _level(self, drone: Drone, here: Point) -> float:
        key = drone.category, drone.home, here
        if key not in self._levels:
            self._levels[key] = self.reach.level(*key, chain_of(self.trips))
        return self._levels[key]


class Needs:
    """What the waiting requests need of one drone where it stands, the least first.

    Most are known by a lower bound: the exact level, which takes a route search, is seldom needed.
    """

    def __init__(self, drone: Drone, arrived: Sequence[Request]) -> None:
        """`arrived`: the requests, to which later ones are appended."""
        self.place, self._drone, self._arrived, self._seen = drone.location, drone, arrived, 0
        self._heap: list[tuple[float, int, bool, Request]] = []

    def least(self, most: float = inf) -> float:
        """Return the least level that suffices for a request that waits; infinite: none up to `most` does."""
        heap, drone, place = self._heap, self._drone, self.place
        for request in self._arrived[self._seen :]:
            if not request.is_set:
                heappush(heap, (request.at_least(drone, place), request.rank[1], False, request))
        self._seen = len(self._arrived)
        while heap:
            level, number, is_exact, request = heap[0]
            if request.is_set:
                heappop(heap)
            elif level > most:
                break
            elif is_exact:
                return level
            else:
                heapreplace(heap, (request.level(drone), number, True, request))
        return inf

    def up_to(self, level: float, most: int) -> list[Request]:
        """Return the requests that need no more than a level; of many, one more than `most`."""
        found = list[tuple[float, int, bool, Request]]()
        while len(found) <= most and self.least(level) < inf:
            found.append(heappop(self._heap))
        for one in found:
            heappush(self._heap, one)
        return [request for *_, request in found]


UNCHARGED = "what is left in its battery is too little, and nothing charges it at home"
