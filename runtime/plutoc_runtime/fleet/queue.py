"""The queue in which missions wait for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival. A free drone that
is too low for all who wait is put aside until it is charged for its share of them.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from heapq import heappop, heappush, heapreplace
from math import hypot, inf
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from ..domain.errors import HookFault, MissionFailed
from ..domain.keeper import put, trips_of
from ..domain.status import IN_THE_AIR, DroneStatus
from ..time.kernel import FLEET, EventKind, Future, Kernel, Timer
from .reach import Reach, chain_of, docked, miss_of

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Mission, Point, Trip
    from .policies import Choice, Policy
    from .reach import Bounds


def _flies(drone: Drone) -> bool:
    free = drone.status is _FREE  # and in the air, if it is offered as it hovers
    return not drone.telemetry.landed if free else drone.status in IN_THE_AIR


UNCHARGED = "what is left in its battery is too little, and nothing charges it at home"
_FREE = DroneStatus.FREE
_SERVE = EventKind.SERVE
_by_rank = attrgetter("rank")


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
        telemetry = drone.telemetry
        level = telemetry.battery_level
        here = telemetry.location
        if here == drone.home and level >= self.takes(drone.category)[2]:
            return True
        return level >= self.level(drone, here)

    def ever(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip from its home with a full battery."""
        return self.takes(drone.category)[2] <= 1.0 or self.level(drone, drone.home) < inf

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with all that its battery will have; None: it can."""
        if not self.ever(drone):
            reach = self._reach
            chain = chain_of(self.trips)
            miss = miss_of(reach.app, reach.airspace, drone.category, drone.home, chain)
            return miss and miss.reason
        if drone.category.charge_time == inf and not self.able(drone):
            is_final = drone.telemetry.landed and docked(drone.location, drone.home)
            return UNCHARGED if is_final else None
        return None

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
        from_x, from_y, height = here
        home_x, home_y, _ = drone.home
        level = a_metre * (hypot(x - from_x, y - from_y) + hypot(x - home_x, y - home_y))
        # one in the air has taken off already; and no bound is below 0 where it leads is not a number
        return max(0.0, upright + level if height <= 0.0 else level)

    def takes(self, category: Category) -> Bounds:
        """Return at least what one trip takes of a battery."""
        bounds = self._bounds.get(category)
        if bounds is None:
            bounds = self._reach.takes(category, self.trip)
            self._bounds[category] = bounds
        return bounds


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


class Queue:
    """The waiting requests, and the free drones."""

    def __init__(
        self, kernel: Kernel, reach: Reach, drones: list[Drone], max_airborne: int | None
    ) -> None:
        """`drones`: the fleet's very list, which grows as drones join."""
        self.kernel = kernel
        self.drones = drones
        self._reach = reach
        self._max_airborne = inf if max_airborne is None else max_airborne
        self.requests: list[Request] = []  # sorted by rank, the last is served first
        self._fresh: list[Request] = []  # the requests that have not been looked at yet
        self._arrived: list[Request] = []  # those that wait, and some that have; see `Needs`
        self._needs: dict[Drone, Needs] = {}
        self._arrivals = 0
        self.ready: list[Drone] = []  # while it is served: those that may be chosen, in order
        self.low: dict[Drone, tuple[float, float]] = {}
        """The other free drones: too low for every request so far, until when, and what level they need."""
        self.plans: dict[object, Any] = {}  # what policies remember from one serving to the next
        self.homeward: set[Drone] = set()  # those that were sent home since they flew a trip
        self.stay_out = True  # whether drones stay where a trip ends, but for those that are low
        self._one_is_lost = False  # since the requests were last checked
        self._is_due = False  # whether it is served at the end of this instant
        self._recheck = Timer(int)
        self._recheck_at = inf
        self.served: Callable[[], None] = lambda: None
        """Called after a serving, if some still wait and a drone that is too low is not being charged."""
        self.entered: Callable[[Mission[Any]], object] | None = None
        """Called with each mission that is about to enter."""

    def enter(self, mission: Mission[Any], policy: Policy, priority: int) -> Request:
        """Request a drone for a mission's next trip; it is given at the end of this instant or later."""
        if self.entered is not None:
            self.entered(mission)
        self._arrivals -= 1
        rank = (priority, self._arrivals)
        request = Request(self._reach, mission, policy, rank, self.kernel.now)
        insort(self.requests, request, key=_by_rank)
        self._fresh.append(request)
        self.changed()
        return request

    def leave(self, request: Request) -> None:
        """Withdraw a request."""
        del self.requests[self._place(request)]
        request.is_set = True

    def moved(self, drone: Drone) -> None:
        """Called when a drone's status was set: serve the queue at the end of this instant."""
        self.low.pop(drone, None)
        if drone.status is DroneStatus.LOST:
            self._one_is_lost = True
        self.changed()

    def changed(self) -> None:
        """Serve the queue at the end of this instant."""
        if self.requests and not self._is_due:
            self._is_due = True
            self.kernel.at(self.kernel.now, _SERVE, FLEET, self._serve)

    def prioritise(self, trip: Trip, priority: int) -> None:
        """Change the priority of the request for this trip."""
        for request in self.requests:
            if request.trip is trip:
                request.rank = (priority, request.rank[1])
                self.requests.sort(key=_by_rank)
                self.changed()
                return

    @property
    def waiting(self) -> bool:
        """Whether any request waits."""
        return bool(self.requests)

    def summary(self) -> str:
        """Return a summary of what the drones are doing: why a mission waits."""
        count = Counter(drone.status for drone in self.drones)
        return ", ".join(f"{count[s]} {s.value.lower()}" for s in DroneStatus if count[s])

    @property
    def room(self) -> bool:
        """Whether one more drone may fly."""
        most = self._max_airborne
        return most == inf or sum(map(_flies, self.drones)) < most

    def too_low(self) -> Iterator[Drone]:
        """Yield the free drones that waiting missions could use if they were charged."""
        for drone in self.drones:
            if drone in self.low and any(one.never(drone) is None for one in self.requests):
                yield drone

    def ready_at(self, drone: Drone) -> float | None:
        """Return until when a drone is put aside; None: until something else happens."""
        until, _ = self.low.get(drone, (inf, inf))
        return until if until < inf else None

    # Serving

    def _serve(self) -> None:
        self._is_due = False
        self._arrived += self._fresh
        if not self._needs or len(self._arrived) > 1_000 + 8 * len(self.requests):
            self._arrived = self.requests[:]
            self._needs = {}
        if self.low and (self._fresh or self.kernel.now >= self._recheck_at):
            self._put_back_the_charged()
        ready = [one for one in self.drones if one.status is _FREE and one not in self.low]
        self.ready = ready if self.room else [*filter(_flies, ready)]
        if self.ready:
            self._share_out()
        if self.requests:
            self._refuse_what_cannot_be()
            if self.ready and self.room:
                self._put_aside_the_low()
            if self.low:
                untils = [until for until, _ in self.low.values()]
                self._look_again_when_charged(min(untils))
                if max(untils) == inf:
                    self.served()
        self._fresh.clear()

    def _share_out(self) -> None:
        """Ask for each request which drone it gets, until no drone that is left suffices for any."""
        place = len(self.requests)
        before = inf
        while place and self.ready and (self.room or any(map(_flies, self.ready))):
            if len(self.ready) == before and not self._is_suited(self.requests[place - 1]):
                place -= 1
                continue
            before = len(self.ready)
            place = self._ask(place - 1)
            if len(self.ready) == before and not any(map(self._suffices, self.ready)):
                return

    def _suffices(self, drone: Drone) -> bool:
        return self._needs_of(drone).least(drone.battery_level) < inf

    def _is_suited(self, request: Request) -> bool:
        return any(
            drone.battery_level >= request.at_least(drone, drone.location) and request.able(drone)
            for drone in self.ready
        )

    def _ask(self, place: int) -> int:
        """Ask which drone the request at this place gets; return the least place that this was asked for."""
        request = self.requests[place]
        share = getattr(request.policy, "share", None)
        if share is not None:
            return int(share(self, place))
        try:
            choice = request.policy(request.trip, self.ready, request.able)
        except HookFault as fault:
            self.refuse(request, fault)
        else:
            self.give(place, choice)
        return place

    def give(self, place: int, choice: Choice | None) -> None:
        """Give the request at this place a drone, if one was chosen."""
        if choice is not None and (self.room or _flies(choice[0])):
            request = self.requests.pop(place)
            drone, request.why = choice
            self.ready.remove(drone)
            put(drone, status=DroneStatus.BUSY)  # at once: no other request may have it
            request.set(drone)

    def refuse(self, request: Request, error: MissionFailed) -> None:
        """Fail a request, and with it its mission."""
        del self.requests[self._place(request)]
        request.fail(error)

    def _place(self, request: Request) -> int:
        place = bisect_left(self.requests, request.rank, key=_by_rank)
        assert self.requests[place] is request
        return place

    def _refuse_what_cannot_be(self) -> None:
        """Refuse requests that no drone can serve: new ones, and all after a loss, or where none is charged."""
        again = self._one_is_lost or self._reach.app.categories[0].charge_time == inf
        asked = tuple(reversed(self.requests)) if again else self._fresh
        self._one_is_lost = False
        for request in asked:
            if not request.is_set and (why := self._never(request)) is not None:
                lacking = f"no drone of the fleet can fly trip {request.trip.name}: {why}"
                self.refuse(request, MissionFailed(lacking))

    def _never(self, request: Request) -> str | None:
        """Return why none of the drones that are left can ever fly a trip; None: one can."""
        reasons: list[str] = []
        for drone in self.drones:
            if drone.status is not DroneStatus.LOST:
                why = request.never(drone)
                if why is None:
                    return None
                reasons.append(why)
        if lost := len(self.drones) - len(reasons):
            reasons.insert(0, f"{lost} of {len(self.drones)} drones are lost")
        return "; ".join(dict.fromkeys(reasons))

    # Drones that are too low

    def _needs_of(self, drone: Drone) -> Needs:
        needs = self._needs.get(drone)
        if needs is None or needs.place != drone.location:
            needs = Needs(drone, self._arrived)
            self._needs[drone] = needs
        return needs

    def _put_back_the_charged(self) -> None:
        """Make drones ready again that have charged, or that suffice for a new request."""
        now = self.kernel.now
        usual = self.requests[0].rank[0] if self.requests else 0
        urgent = [one for one in self._fresh if one.hurries or one.rank[0] > usual]
        for drone, (until, wanted) in list(self.low.items()):
            if until <= now or any(request.able(drone) for request in urgent):
                del self.low[drone]
            elif self._fresh and (least := self._needs_of(drone).least(wanted)) < wanted:
                if drone.battery_level >= least:
                    del self.low[drone]
                else:
                    self.low[drone] = (min(until, self.charged(drone, least)), least)

    def _put_aside_the_low(self) -> None:
        """Put drones aside that are too low for every request; a docked one until it has charged for its share.

        A drone that suffices and was not chosen (by a policy, or as no more may fly) stays ready.
        """
        share = -(-len(self.requests) // len(self.drones))  # trips for each drone
        for drone in self.ready:
            least = self._needs_of(drone).least()
            reserve = drone.category.reserve
            if drone.battery_level < least:
                level = max(least, min(1.0, reserve + share * (least - reserve)))
                self.low[drone] = (self.charged(drone, level), least)

    def charged(self, drone: Drone, level: float) -> float:
        """Return when a drone has this level where it stands; infinite: it never will."""
        if level == inf or not docked(drone.location, drone.home):
            return inf
        return self.kernel.now + (drone.charging(level) + 0.001)

    def _look_again_when_charged(self, soonest: float) -> None:
        if soonest != self._recheck_at:
            self._recheck.cancel()
            self._recheck_at = soonest
            if soonest < inf:
                self._recheck = self.kernel.at(soonest, EventKind.CLOCK, FLEET, self.changed)
