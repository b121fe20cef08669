"""`least_makespan`: all waiting trips are planned ahead onto all drones, so that the last one ends soonest.

Each drone has a route, kept from one serving to the next. A new trip is inserted where it costs least (cheapest
insertion); then trips are moved away from the route that ends last, as long as that ends sooner. Seconds are
estimates: a drone flies on when it is free, and not when it was to be. A battery that does not suffice for a route
makes it longer by the time to charge what it lacks.
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
PASSES = 4
"""How often all stops are inserted anew, at most."""
_PLANNED = 0.85
"""The share of a battery's rest that is planned with: the way home is not."""
_FLIES = (DroneStatus.FREE, DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.CHARGING)


@Batch
def least_makespan(
    offers: Sequence[Request], free: Sequence[Drone], queue: Queue
) -> Sequence[Choice | None]:
    """Plan all waiting trips onto all drones, so that the last one ends soonest."""
    until: dict[Drone, tuple[float, Point]] = queue.plans.setdefault("until", {})
    plan: _Plan = queue.plans.setdefault((least_makespan, offers[0].rank[0]), _Plan())
    if len(offers) > MOST:
        chosen = plan.nearest(offers, free)
    else:
        plan.renew(offers, free, queue, until)
        chosen = plan.next(free)
    now, given = queue.kernel.now, dict[Request, "Choice"]()
    for drone, request in chosen.items():
        metres = drone.distance(request.goal)
        seconds = busy(drone.category, request) + metres * pace(drone.category, request)
        until[drone] = now + seconds, ends(request)
        why = f"planned so that the last of {len(offers)} waiting trips ends soonest"
        given[request] = drone, f"{why}: {metres:.1f} m away"
    return [given.get(request) for request in offers]


class _Route:
    """What one drone is to fly, and from when and where on."""

    def __init__(self) -> None:
        self.stops: list[Request] = []

    def begin(self, drone: Drone, start: float, now: float, place: Point) -> None:
        kind, self.drone, self.waits, self.place = drone.category, drone, start - now, place
        left = (drone.battery_level - kind.reserve) * kind.endurance * _PLANNED
        self.lasts = left - (start - now if drone.status is DroneStatus.BUSY else 0.0)
        self.slower = kind.charge_time / kind.endurance
        self.seconds = self.flown(self.stops)

    def flown(self, stops: Sequence[Request]) -> float:
        """Return the seconds that stops take."""
        here, kind, seconds = self.place, self.drone.category, 0.0
        for stop in stops:
            seconds += busy(kind, stop) + pace(kind, stop) * _metres(here, stop.goal)
            here = ends(stop)
        return seconds

    def end(self, seconds: float) -> float:
        """Return in how many seconds the drone is through, if its stops take so long."""
        return self.waits + seconds + max(0.0, seconds - self.lasts) * self.slower

    def cost(self, seconds: float) -> float:
        """Return the square of its end: the less all these together, the sooner the last ends, and all."""
        return self.end(seconds) ** 2

    def with_one_more(self, one: Request) -> Iterator[tuple[float, int]]:
        """Yield the seconds with one more stop, at each place."""
        kind, here, goal, last = self.drone.category, self.place, one.goal, ends(one)
        alone, a_metre = self.seconds + busy(kind, one), pace(kind, one)
        for place, stop in enumerate(self.stops):
            there = stop.goal
            more = _metres(here, goal) + _metres(last, there) - _metres(here, there)
            yield alone + a_metre * more, place
            here = ends(stop)
        yield alone + a_metre * _metres(here, goal), len(self.stops)


class _Plan:
    """The routes of all drones that can fly."""

    def __init__(self) -> None:
        self.routes: dict[Drone, _Route] = {}

    def nearest(self, offers: Sequence[Request], free: Sequence[Drone]) -> dict[Drone, Request]:
        """Return the nearest request for each drone."""
        left, chosen = dict.fromkeys(offers), dict[Drone, Request]()
        for drone in free:
            by_way = sorted(left, key=lambda request: drone.distance(request.goal))
            if (request := next((one for one in by_way if one.able(drone)), None)) is not None:
                chosen[drone] = request
                del left[request]
        return chosen

    def renew(
        self,
        offers: Sequence[Request],
        free: Sequence[Drone],
        queue: Queue,
        until: dict[Drone, tuple[float, Point]],
    ) -> None:
        """Bring the routes up to date: what waits no more is gone, and what is new is inserted."""
        now, waiting, routes = queue.kernel.now, set(offers), dict[Drone, _Route]()
        for drone in queue.drones:
            if drone.status in _FLIES:
                routes[drone] = route = self.routes.get(drone) or _Route()
                start, place = until.get(drone, (now, drone.location))
                if drone in queue.low:
                    start = queue.low[drone][0]
                if start <= now or start == inf or drone in free:
                    start, place = now, drone.location
                route.stops = [one for one in route.stops if one in waiting]
                waiting.difference_update(route.stops)
                route.begin(drone, start, now, place)
        self.routes = routes
        fresh = [one for one in offers if one in waiting]
        places = [route.place for route in routes.values()]
        fresh.sort(key=lambda one: -min(_metres(place, one.goal) for place in places))
        for one in fresh:
            self._insert(one)
        if fresh or any(not routes[drone].stops for drone in free):
            self._improve()

    def _insert(self, one: Request) -> _Route | None:
        """Insert a stop where it costs least, and return the route; None: no drone can ever fly it."""
        least, best = inf, None
        for route in self.routes.values():
            if one.ever(route.drone):
                before = route.cost(route.seconds)
                for seconds, place in route.with_one_more(one):
                    if (cost := route.cost(seconds) - before) < least:
                        least, best = cost, (route, seconds, place)
        if best is None:
            return None
        route, route.seconds, place = best
        route.stops.insert(place, one)
        return route

    def _improve(self) -> None:
        """Take each stop out, and insert it anew, until nothing is better that way."""
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
        """Return the next stop of each drone; without one, what it would have done before its own drone is there."""
        chosen, idle = dict[Drone, Request](), list[Drone]()
        for drone in free:
            stops = self.routes[drone].stops
            if (one := next((stop for stop in stops if stop.able(drone)), None)) is not None:
                chosen[drone] = one
                stops.remove(one)
            else:
                idle.append(drone)
        for drone in idle:
            if (found := self._sooner(drone)) is not None:
                route, chosen[drone] = found
                route.stops.remove(chosen[drone])
        return chosen

    def _sooner(self, drone: Drone) -> tuple[_Route, Request] | None:
        own, found = self.routes[drone], list[tuple[float, int, _Route, Request]]()
        for route in self.routes.values():
            for number, one in enumerate(route.stops if route is not own else ()):
                kind = drone.category
                mine = own.waits + busy(kind, one) + drone.distance(one.goal) * pace(kind, one)
                if mine < route.end(route.flown(route.stops[: number + 1])):
                    found.append((mine, len(found), route, one))
        return next(((route, one) for *_, route, one in sorted(found) if one.able(drone)), None)


def _metres(here: Point, there: Point) -> float:
    return hypot(here[0] - there[0], here[1] - there[1])
