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

from ..domain.model import Category, Drone, Point
from ..domain.status import DroneStatus
from .batch import Batch
from .durations import busy, ends, pace
from .needs import Request

if TYPE_CHECKING:
    from .policies import Choice
    from .queue import Queue

MOST = 100
"""Of more requests than these each drone flies the nearest: where so many are left nothing need be planned."""
PASSES = 4  # how often each route is improved at one serving, at most
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
    for drone, stop in chosen.items():
        until[drone] = queue.kernel.now + stop.seconds(drone.category, drone.location), stop.last
        given[stop.one] = drone, f"{why}: {drone.distance(stop.goal):.1f} m away"
    return [given.get(one) for one in requests]


def _nearest(requests: Sequence[Request], free: Sequence[Drone]) -> dict[Drone, _Stop]:
    """Return the nearest request for each drone."""
    left, chosen = dict.fromkeys(requests), dict[Drone, _Stop]()
    for drone in free:
        by_way = sorted(left, key=lambda one: drone.distance(one.goal))
        if (found := next((one for one in by_way if one.able(drone)), None)) is not None:
            chosen[drone] = _Stop(found)
            del left[found]
    return chosen


def _metres(here: Point, there: Point) -> float:
    return hypot(here[0] - there[0], here[1] - there[1])


class _Stop:
    """A request on a route."""

    def __init__(self, one: Request) -> None:
        self.one, self.goal, self.last = one, one.goal, ends(one)
        self.busy = {kind: busy(kind, one) for kind in one.bounds}
        self.pace = {kind: pace(kind, one) for kind in one.bounds}

    def seconds(self, kind: Category, here: Point) -> float:
        """Return about how long a drone takes from a place to the end of it."""
        return self.busy[kind] + self.pace[kind] * _metres(here, self.goal)


class _Route:
    """What one drone is to fly, and from when and where on."""

    def __init__(self, drone: Drone) -> None:
        self.drone, self.stops = drone, list[_Stop]()

    def begin(self, waits: float, place: Point) -> None:
        """Begin anew: in so many seconds, and there."""
        drone, kind, self.waits, self.place = self.drone, self.drone.category, waits, place
        left = (drone.battery_level - kind.reserve) * kind.endurance * _PLANNED
        self.lasts = left - (waits if drone.status is _BUSY else 0.0)
        self.slower = kind.charge_time / kind.endurance
        self.seconds = self.flown(self.stops)

    def flown(self, stops: Sequence[_Stop]) -> float:
        """Return the seconds that stops take."""
        here, seconds = self.place, 0.0
        for stop in stops:
            seconds, here = seconds + stop.seconds(self.drone.category, here), stop.last
        return seconds

    def end(self, seconds: float) -> float:
        """Return in how many seconds the drone is through, if its stops take so long."""
        return self.waits + seconds + max(0.0, seconds - self.lasts) * self.slower

    def with_one_more(self, new: _Stop) -> Iterator[tuple[float, int]]:
        """Yield the seconds with one more stop, at each place."""
        here, goal, last, a_metre = self.place, new.goal, new.last, new.pace[self.drone.category]
        alone, place = self.seconds + new.busy[self.drone.category], 0
        for stop in self.stops:
            more = _metres(here, goal) + _metres(last, stop.goal) - _metres(here, stop.goal)
            yield alone + a_metre * more, place
            here, place = stop.last, place + 1
        yield alone + a_metre * _metres(here, goal), place


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
                route.stops = [stop for stop in route.stops if stop.one in new]
                new.difference_update(stop.one for stop in route.stops)
                # one that is late will take as long again as it is late by now, for all one knows
                route.begin(0.0 if drone in free else abs(then - now), place)
        fresh = [_Stop(one) for one in requests if one in new]
        places = [route.place for route in self.routes.values()]
        fresh.sort(key=lambda stop: -min(_metres(place, stop.goal) for place in places))
        changed = dict.fromkeys(filter(None, map(self._insert, fresh)))
        if any(not self.routes[drone].stops for drone in free):
            last = max(self.routes.values(), key=lambda route: route.end(route.seconds))
            changed[last] = None
        self._improve(changed)

    def _insert(self, stop: _Stop) -> _Route | None:
        """Insert a stop where it costs least, and return the route; None: no drone can ever fly it."""
        least, best = inf, None
        for route in self.routes.values():
            if stop.one.ever(route.drone):
                before = route.end(route.seconds) ** 2
                for seconds, place in route.with_one_more(stop):
                    if (cost := route.end(seconds) ** 2 - before) < least:
                        least, best = cost, (route, seconds, place)
        if best is None:
            return None
        route, route.seconds, place = best
        route.stops.insert(place, stop)
        return route

    def _improve(self, changed: dict[_Route, None]) -> None:
        """Insert the stops of changed routes anew, until nothing changes."""
        for _ in range(PASSES * len(self.routes)):
            if not changed:
                return
            route = next(iter(changed))
            del changed[route]
            for stop in route.stops[:]:
                place = route.stops.index(stop)
                del route.stops[place]
                route.seconds = route.flown(route.stops)
                other = self._insert(stop)
                if other is not None and (other is not route or stop is not route.stops[place]):
                    changed |= {route: None, other: None}

    def next(self, free: Sequence[Drone]) -> dict[Drone, _Stop]:
        """Return the next stop of each drone; without one, one that it reaches before its own drone."""
        chosen, idle = dict[Drone, _Stop](), list[_Route]()
        for route in map(self.routes.__getitem__, free):
            able = (stop for stop in route.stops if stop.one.able(route.drone))
            if (stop := next(able, None)) is not None:
                chosen[route.drone] = stop
                route.stops.remove(stop)
            else:
                idle.append(route)
                route.waits = inf  # it must be charged for what it has
        for route in idle if any(route.stops for route in self.routes.values()) else ():
            sooner = sorted(self._sooner(route.drone), key=lambda found: found[:2])
            for *_, other, stop in sooner:
                if stop.one.able(route.drone):
                    chosen[route.drone] = stop
                    other.stops.remove(stop)
                    break
        return chosen

    def _sooner(self, drone: Drone) -> Iterator[tuple[float, int, _Route, _Stop]]:
        """Yield the stops that a free drone would have flown before their own."""
        for number, route in enumerate(self.routes.values()):
            for place, stop in enumerate(route.stops):
                mine = stop.seconds(drone.category, drone.location)
                if mine < route.end(route.flown(route.stops[: place + 1])):
                    yield mine, number, route, stop
