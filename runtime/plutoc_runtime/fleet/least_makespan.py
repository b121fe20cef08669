"""`least_makespan`: all waiting trips are planned ahead onto all drones, so that the last one ends soonest.

Each drone has a route, kept from one serving to the next. New trips are inserted where they cost least, and stops of
changed routes anew (cheapest insertion, relocation). Costs are the squares of the routes' ends, in seconds, which are
estimates; as these count a second drone's whole way, drones without a route relieve the last in the end. What a battery
lacks for a route makes it longer by the time to charge that.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from math import dist, inf
from typing import TYPE_CHECKING

from ..domain.model import Category, Drone, Point
from ..domain.status import DroneStatus
from .batch import Batch
from .durations import FLIES, busy, ends, free_again, look_again, pace

if TYPE_CHECKING:
    from .policies import Choice
    from .queue import Queue, Request

MOST = 100
"""Of more requests those that came first are planned, so that no choice takes long."""
PASSES = 4  # how often each route is improved at one serving, at most
_ENDLESS = 1e9  # seconds that a charge is counted with that never comes
_PLANNED = 0.85  # of what is left in a battery: the way home is not planned
_Until = dict[Drone, tuple[float, Point]]  # when a drone is to have flown, and where it is then


@Batch
def least_makespan(
    requests: Sequence[Request], free: Sequence[Drone], queue: Queue
) -> Sequence[Choice | None]:
    """Plan all waiting trips onto all drones, so that the last one ends soonest."""
    plan: _Plan = queue.plans.setdefault((least_makespan, requests[0].rank[0]), _Plan())
    until: _Until = queue.plans.setdefault("until", {})
    plan.renew(requests[:MOST], free, queue)
    chosen = plan.next(free)
    if plan.again < inf:  # the other may be late, and nothing else happens
        look_again(queue, plan, plan.again)
    why = f"planned so that the last of {len(requests)} waiting trips ends soonest"
    given: dict[Request, Choice] = {}
    for drone, stop in chosen.items():
        ends_at = queue.kernel.now + stop.seconds(drone.category, drone.location)
        until[drone] = (ends_at, stop.last)
        given[stop.one] = (drone, f"{why}: {drone.distance(stop.goal):.1f} m away")
    return [given.get(one) for one in requests]


def _metres(here: Point, there: Point) -> float:
    return dist(here[:2], there[:2])


class _Stop:
    """A request on a route."""

    def __init__(self, one: Request, kinds: Collection[Category]) -> None:
        self.one = one
        self.goal = one.goal
        self.last = ends(one)
        self.busy = {kind: busy(kind, one) for kind in kinds}
        self.pace = {kind: pace(kind, one) for kind in kinds}

    def seconds(self, kind: Category, here: Point) -> float:
        """Return about how long a drone takes from a place to the end of it."""
        return self.busy[kind] + self.pace[kind] * _metres(here, self.goal)


class _Route:
    """What one drone is to fly, and from when and where on."""

    def __init__(self, drone: Drone) -> None:
        self.drone = drone
        self.stops: list[_Stop] = []

    def begin(self, waits: float, place: Point) -> None:
        """Begin anew: in so many seconds, and there."""
        kind = self.drone.category
        self.waits = waits
        self.place = place
        left = (self.drone.battery_level - kind.reserve) * kind.endurance * _PLANNED
        self.lasts = left - (waits if self.drone.status is DroneStatus.BUSY else 0.0)
        self.slower = min(kind.charge_time, _ENDLESS) / kind.endurance
        self.seconds = self.flown(self.stops)

    def flown(self, stops: Sequence[_Stop]) -> float:
        """Return the seconds that stops take."""
        here = self.place
        seconds = 0.0
        for stop in stops:
            seconds += stop.seconds(self.drone.category, here)
            here = stop.last
        return seconds

    def end(self, seconds: float) -> float:
        """Return in how many seconds the drone is through, if its stops take so long."""
        return self.waits + seconds + max(0.0, seconds - self.lasts) * self.slower

    def with_one_more(self, new: _Stop) -> Iterator[tuple[float, int]]:
        """Yield the seconds with one more stop, at each place."""
        a_metre = new.pace[self.drone.category]
        alone = self.seconds + new.busy[self.drone.category]
        here = self.place
        for place, stop in enumerate(self.stops):
            more = _metres(here, new.goal) + _metres(new.last, stop.goal) - _metres(here, stop.goal)
            yield alone + a_metre * more, place
            here = stop.last
        yield alone + a_metre * _metres(here, new.goal), len(self.stops)


class _Plan:
    """The routes of all drones that can fly."""

    def __init__(self) -> None:
        self.routes: dict[Drone, _Route] = {}
        self.again = inf  # in how many seconds a drone that waits for another may fly for it

    def renew(self, requests: Sequence[Request], free: Sequence[Drone], queue: Queue) -> None:
        """Bring the routes up to date: what waits no more is gone, and what is new is inserted."""
        new = set(requests)
        ready = set(free)
        before = self.routes
        self.routes = {}
        for drone in queue.drones:
            if drone.status in FLIES:
                route = before.get(drone) or _Route(drone)
                self.routes[drone] = route
                waits, place = free_again(drone, queue)
                route.stops = [stop for stop in route.stops if stop.one in new]
                new.difference_update(stop.one for stop in route.stops)
                route.begin(0.0 if drone in ready else waits, place)
        kinds = {drone.category for drone in queue.drones}
        fresh = [_Stop(one, kinds) for one in requests if one in new]
        places = [route.place for route in self.routes.values()]
        fresh.sort(key=lambda stop: -min(_metres(place, stop.goal) for place in places))
        changed = dict.fromkeys(filter(None, map(self._insert, fresh)))
        if any(not self.routes[drone].stops for drone in free):
            changed[self._last()] = None
        self._improve(changed)
        self._relieve()

    def _insert(self, stop: _Stop) -> _Route | None:
        """Insert a stop where it costs least, and return the route; None: no drone can ever fly it."""
        least = inf
        best = None
        for route in self.routes.values():
            if stop.one.ever(route.drone):
                before = route.end(route.seconds) ** 2
                for seconds, place in route.with_one_more(stop):
                    cost = route.end(seconds) ** 2 - before
                    if cost < least:
                        least = cost
                        best = (route, seconds, place)
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

    def _last(self) -> _Route:
        """Return the route that ends last."""
        return max(self.routes.values(), key=lambda route: route.end(route.seconds))

    def _relieve(self) -> None:
        """Give stops of the route that ends last to drones that have none, while it ends sooner by that."""
        idle = [route for route in self.routes.values() if not route.stops]
        while idle:
            last = self._last()
            least = last.end(last.seconds)
            best = None
            for stop in last.stops:
                rest = last.end(last.flown([one for one in last.stops if one is not stop]))
                for route in idle if rest < least else ():
                    end = max(rest, route.end(route.flown([stop])))
                    if end < least and stop.one.ever(route.drone):
                        least = end
                        best = (stop, route)
            if best is None:
                return
            stop, route = best
            idle.remove(route)
            last.stops.remove(stop)
            route.stops.append(stop)
            for changed in (route, last):
                changed.seconds = changed.flown(changed.stops)

    def next(self, free: Sequence[Drone]) -> dict[Drone, _Stop]:
        """Return the next stop of each drone; without one, one that it has flown before its own drone."""
        self.again = inf
        chosen: dict[Drone, _Stop] = {}
        for drone in free:
            route = self.routes[drone]
            able = (stop for stop in route.stops if stop.one.able(drone))
            if (stop := next(able, None)) is not None:
                chosen[drone] = stop
                route.stops.remove(stop)
            else:
                route.waits = inf  # it must be charged for what it has
        for drone in [drone for drone in free if drone not in chosen]:
            for mine, _, other, stop in sorted(self._flown_by(drone), key=lambda found: found[:2]):
                if stop.one.able(drone):
                    its = other.end(other.flown(other.stops[: other.stops.index(stop) + 1]))
                    if mine < its or stop.one.hurries:
                        chosen[drone] = stop
                        other.stops.remove(stop)
                        break
                    self.again = min(self.again, mine)
        return chosen

    def _flown_by(self, drone: Drone) -> Iterator[tuple[float, int, _Route, _Stop]]:
        """Yield all stops, and in how many seconds a free drone would have flown each."""
        for route in self.routes.values():
            for stop in route.stops:
                yield stop.seconds(drone.category, drone.location), -stop.one.rank[1], route, stop
