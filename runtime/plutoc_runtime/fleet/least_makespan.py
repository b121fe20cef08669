"""`least_makespan`: all waiting trips are planned ahead onto all drones, so that the last one ends soonest.

Each drone has a route, kept from one serving to the next. A new trip is inserted where it costs least, and all stops are
taken out and inserted anew while that makes it better (cheapest insertion, relocation). Costs are the
squares of the routes' ends: so all are short, and the longest most of all. Seconds are estimates: a drone flies on
when it is free. What its battery lacks for a route makes that longer by the time to charge it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot, inf
from typing import TYPE_CHECKING

from ..domain.model import Drone, Point
from ..domain.status import DroneStatus
from .batch import Batch
from .durations import busy, ends, pace
from .needs import Request

if TYPE_CHECKING:
    from .policies import Choice
    from .queue import Queue

MOST = 100
"""Of more requests than these each drone flies the nearest: where so many are left nothing need be planned."""
PASSES = 4  # how often all stops are inserted anew, at most
_PLANNED = 0.85  # of what is left in a battery: the way home is not planned
_FREE, _BUSY = DroneStatus.FREE, DroneStatus.BUSY
_FLIES = (_FREE, _BUSY, DroneStatus.RETURNING, DroneStatus.CHARGING)


@Batch
def least_makespan(
    requests: Sequence[Request], free: Sequence[Drone], queue: Queue
) -> Sequence[Choice | None]:
    """Plan all waiting trips onto all drones, so that the last one ends soonest."""
    plan: _Plan = queue.plans.setdefault((least_makespan, requests[0].rank[0]), _Plan())
    until: dict[Drone, tuple[float, Point]] = queue.plans.setdefault("until", {})
    if len(requests) > MOST:
        chosen = _nearest(requests, free)
    else:
        plan.renew(requests, free, queue, until)
        chosen = plan.next(free)
    why = f"planned so that the last of {len(requests)} waiting trips ends soonest"
    given = dict[Request, "Choice"]()
    for drone, one in chosen.items():
        until[drone] = queue.kernel.now + _seconds(drone, drone.location, one), ends(one)
        given[one] = drone, f"{why}: {drone.distance(one.goal):.1f} m away"
    return [given.get(one) for one in requests]


def _nearest(requests: Sequence[Request], free: Sequence[Drone]) -> dict[Drone, Request]:
    """Return the nearest request for each drone."""
    left, chosen = dict.fromkeys(requests), dict[Drone, Request]()
    for drone in free:
        by_way = sorted(left, key=lambda one: drone.distance(one.goal))
        if (found := next((one for one in by_way if one.able(drone)), None)) is not None:
            chosen[drone] = found
            del left[found]
    return chosen


def _metres(here: Point, there: Point) -> float:
    return hypot(here[0] - there[0], here[1] - there[1])


def _seconds(drone: Drone, here: Point, one: Request) -> float:
    """Return about how long a drone takes from a place through a stop."""
    kind = drone.category
    return busy(kind, one) + pace(kind, one) * _metres(here, one.goal)


class _Route:
    """What one drone is to fly, and from when and where on."""

    def __init__(self, drone: Drone) -> None:
        self.drone, self.stops = drone, list[Request]()

    def begin(self, waits: float, place: Point) -> None:
        """Begin anew: in so many seconds, and there."""
        drone, kind, self.waits, self.place = self.drone, self.drone.category, waits, place
        left = (drone.battery_level - kind.reserve) * kind.endurance * _PLANNED
        self.lasts = left - (waits if drone.status is _BUSY else 0.0)
        self.slower = kind.charge_time / kind.endurance
        self.seconds = self.flown(self.stops)

    def flown(self, stops: Sequence[Request]) -> float:
        """Return the seconds that stops take."""
        here, seconds = self.place, 0.0
        for stop in stops:
            seconds, here = seconds + _seconds(self.drone, here, stop), ends(stop)
        return seconds

    def end(self, seconds: float) -> float:
        """Return in how many seconds the drone is through, if its stops take so long."""
        return self.waits + seconds + max(0.0, seconds - self.lasts) * self.slower

    def with_one_more(self, one: Request) -> Iterator[tuple[float, int]]:
        """Yield the seconds with one more stop, at each place."""
        kind, here, goal, last = self.drone.category, self.place, one.goal, ends(one)
        alone, a_metre = self.seconds + busy(kind, one), pace(kind, one)
        for place, stop in enumerate(self.stops):
            more = _metres(here, goal) + _metres(last, stop.goal) - _metres(here, stop.goal)
            yield alone + a_metre * more, place
            here = ends(stop)
        yield alone + a_metre * _metres(here, goal), len(self.stops)


class _Plan:
    """The routes of all drones that can fly."""

    def __init__(self) -> None:
        self.routes: dict[Drone, _Route] = {}

    def renew(
        self,
        requests: Sequence[Request],
        free: Sequence[Drone],
        queue: Queue,
        until: dict[Drone, tuple[float, Point]],
    ) -> None:
        """Bring the routes up to date: what waits no more is gone, and what is new is inserted."""
        now, new, before, self.routes = queue.kernel.now, set(requests), self.routes, {}
        for drone in queue.drones:
            if drone.status in _FLIES:
                self.routes[drone] = route = before.get(drone) or _Route(drone)
                then, place = until.get(drone, (now, drone.location))
                if drone in queue.low and queue.low[drone][0] < inf:
                    then = queue.low[drone][0]
                if drone.status is _FREE or then < now:
                    place = drone.location
                route.stops = [one for one in route.stops if one in new]
                new.difference_update(route.stops)
                # one that is late will take as long again as it is late by now, for all one knows
                route.begin(0.0 if drone in free else abs(then - now), place)
        fresh = [one for one in requests if one in new]
        places = [route.place for route in self.routes.values()]
        fresh.sort(key=lambda one: -min(_metres(place, one.goal) for place in places))
        for one in fresh:
            self._insert(one)
        if fresh or any(not self.routes[drone].stops for drone in free):
            self._improve()

    def _insert(self, one: Request) -> _Route | None:
        """Insert a stop where it costs least, and return the route; None: no drone can ever fly it."""
        least, best = inf, None
        for route in self.routes.values():
            if one.ever(route.drone):
                before = route.end(route.seconds) ** 2
                for seconds, place in route.with_one_more(one):
                    if (cost := route.end(seconds) ** 2 - before) < least:
                        least, best = cost, (route, seconds, place)
        if best is None:
            return None
        route, route.seconds, place = best
        route.stops.insert(place, one)
        return route

    def _improve(self) -> None:
        for _ in range(PASSES):
            moved = False
            for route in self.routes.values():
                for one in route.stops[:]:
                    place = route.stops.index(one)
                    del route.stops[place]
                    route.seconds = route.flown(route.stops)
                    moved |= self._insert(one) is not route or route.stops[place] is not one
            if not moved:
                return

    def next(self, free: Sequence[Drone]) -> dict[Drone, Request]:
        """Return the next stop of each drone; without one, one that it reaches before its own drone."""
        chosen, idle = dict[Drone, Request](), list[_Route]()
        for route in map(self.routes.__getitem__, free):
            able = (stop for stop in route.stops if stop.able(route.drone))
            if (one := next(able, None)) is not None:
                chosen[route.drone] = one
                route.stops.remove(one)
            else:
                idle.append(route)
                route.waits = inf  # it must be charged for what it has
        for route in idle:
            sooner = sorted(self._sooner(route.drone), key=lambda found: found[:2])
            for *_, other, one in sooner:
                if one.able(route.drone):
                    chosen[route.drone] = one
                    other.stops.remove(one)
                    break
        return chosen

    def _sooner(self, drone: Drone) -> Iterator[tuple[float, int, _Route, Request]]:
        """Yield the stops that a free drone would have flown before their own."""
        for number, route in enumerate(self.routes.values()):
            for place, one in enumerate(route.stops):
                mine = _seconds(drone, drone.location, one)
                if mine < route.end(route.flown(route.stops[: place + 1])):
                    yield mine, number, route, one
