"""Requests for drones, and the battery level that each needs of a drone where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush, heapreplace
from math import hypot, inf
from typing import TYPE_CHECKING, Any

from ..domain.keeper import trips_of
from ..time.kernel import Future
from .reach import Reach, chain_of, docked, miss_of

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Mission, Point, Trip
    from .policies import Policy
    from .reach import Bounds

UNCHARGED = "what is left in its battery is too little, and nothing charges it at home"


class Request(Future["Drone"]):
    """A mission's request for a drone; as a future it is set to the drone that it gets."""

    def __init__(
        self,
        reach: Reach,
        mission: Mission[Any],
        policy: Policy,
        rank: tuple[int, int],
        since: float = 0.0,
    ) -> None:
        """`rank`: its priority, and minus the number of its arrival; the highest is served first."""
        super().__init__()
        self._reach = reach
        self.mission = mission
        self.policy = policy
        self.rank = rank
        self.since = since
        self.trips = trips_of(mission)
        self.trip: Trip = self.trips[0]
        self.goal: Point = self.trip.source or self.trip.target  # where its drone flies to first
        self.why = ""  # why its drone was chosen
        self.hurries = False  # its mission waits for a limited time only
        self._bounds: dict[Category, Bounds] = {}
        self._levels: dict[tuple[Category, Point, Point], float] = {}

    def able(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip now."""
        level = drone.telemetry.battery_level
        here = drone.telemetry.location
        if here == drone.home and level >= self.takes(drone.category)[2]:
            return True
        return level >= self.level(drone, here)

    def ever(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip from its home with a full battery."""
        return self.takes(drone.category)[2] <= 1.0 or self.level(drone, drone.home) < inf

    def level(self, drone: Drone, here: Point) -> float:
        """Return the battery level that a drone needs from here; infinite: none suffices, here or at home."""
        key = (drone.category, drone.home, here)
        level = self._levels.get(key)
        if level is None:
            level = self._reach.level(drone.category, drone.home, here, self.trips)
            if level > 1.0 or (here != drone.home and not self.ever(drone)):
                level = inf
            self._levels[key] = level
        return level

    def at_least(self, drone: Drone, here: Point) -> float:
        """Return a lower bound of the level that a drone needs from here: the straight way there and home."""
        upright, a_metre, _ = self._bounds.get(drone.category) or self.takes(drone.category)
        x, y, _ = self.goal
        a, b, z = here
        c, d, _ = drone.home
        level = a_metre * (hypot(x - a, y - b) + hypot(x - c, y - d))
        # one in the air has taken off already; and no bound is below 0 where it leads is not a number
        return max(0.0, upright + level if z <= 0.0 else level)

    def takes(self, category: Category) -> Bounds:
        """Return bounds of what one trip takes of a battery."""
        bounds = self._bounds.get(category)
        if bounds is None:
            bounds = self._reach.takes(category, self.trip)
            self._bounds[category] = bounds
        return bounds

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with all that its battery will have; None: it can."""
        if not self.ever(drone):
            app, airspace = self._reach.app, self._reach.airspace
            miss = miss_of(app, airspace, drone.category, drone.home, chain_of(self.trips))
            return miss and miss.reason
        if drone.category.charge_time == inf and not self.able(drone):
            is_final = drone.telemetry.landed and docked(drone.location, drone.home)
            return UNCHARGED if is_final else None
        return None


class Needs:
    """What the waiting requests need of one drone where it stands, the least first.

    An exact level takes a search for a route, and there are as many levels as requests times places
    where drones stand. So a request is known by a lower bound until it is the first; only then is its
    exact level asked for, and it finds its place by that.
    """

    def __init__(self, drone: Drone, arrived: Sequence[Request]) -> None:
        """`arrived`: the requests, to which later ones are appended."""
        self.place = drone.location
        self._drone = drone
        self._arrived = arrived
        self._seen = 0
        self._heap: list[tuple[float, int, bool, Request]] = []

    def least(self, most: float = inf) -> float:
        """Return the least level that suffices for a request that waits; infinite: none up to `most` does."""
        heap = self._heap
        for request in self._arrived[self._seen :]:
            if not request.is_set:
                bound = request.at_least(self._drone, self.place)
                heappush(heap, (bound, request.rank[1], False, request))
        self._seen = len(self._arrived)
        while heap:
            level, number, is_exact, request = heap[0]
            if request.is_set:
                heappop(heap)
            elif level > most:
                return inf
            elif is_exact:
                return level
            else:
                heapreplace(heap, (request.level(self._drone, self.place), number, True, request))
        return inf

    def up_to(self, level: float, most: int) -> list[Request]:
        """Return the requests that need no more than a level; of many, one more than `most`."""
        found = list[tuple[float, int, bool, Request]]()
        while len(found) <= most and self.least(level) < inf:
            found.append(heappop(self._heap))
        for one in found:
            heappush(self._heap, one)
        return [request for *_, request in found]
