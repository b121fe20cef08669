"""The queue in which missions wait for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival. A free drone that
is too low for all who wait is put aside until it is charged for its share of them.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Iterator
from math import inf
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from ..domain.errors import HookFault, MissionFailed
from ..domain.keeper import put
from ..domain.status import IN_THE_AIR, DroneStatus
from ..time.kernel import FLEET, EventKind, Kernel, Timer
from .needs import Needs, Request
from .reach import Reach, docked

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from .policies import Choice, Policy

_FREE = DroneStatus.FREE
_BUSY = DroneStatus.BUSY
_LOST = DroneStatus.LOST
_SERVE = EventKind.SERVE
_MANY = 30  # for more requests it is not worth while to find out for which a drone suffices
_by_rank = attrgetter("rank")


class Queue:
    """The waiting requests, and the free drones."""

    def __init__(
        self, kernel: Kernel, reach: Reach, drones: list[Drone], max_airborne: int | None
    ) -> None:
        """`drones`: the fleet's very list, which grows as drones join."""
        self.kernel = kernel
        self.drones = drones
        self._reach = reach
        reach.drones = drones
        self._max_airborne = max_airborne
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
        if self.requests and rank < self.requests[0].rank:  # as most that enter
            self.requests.insert(0, request)
        else:
            insort(self.requests, request, key=_by_rank)
        self._fresh.append(request)
        self.changed()
        return request

    def leave(self, request: Request) -> None:
        """Withdraw a request."""
        self._drop(request)
        request.is_set = True

    def moved(self, drone: Drone) -> None:
        """Called when a drone's status was set: serve the queue at the end of this instant."""
        self.low.pop(drone, None)
        if drone.status is _LOST:
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
        return most is None or sum(drone.status in IN_THE_AIR for drone in self.drones) < most

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
        self.ready = [one for one in self.drones if one.status is _FREE and one not in self.low]
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
        """Ask for each request which drone it gets; after one in vain, for those that a ready drone could fly."""
        place = len(self.requests)
        before = inf
        while place and len(self.ready) < before:
            before = len(self.ready)
            place = self._ask(place - 1)
        if place and self.ready:
            below: tuple[float, int] = self.requests[place - 1].rank
            for request in self._suited():
                if not self.ready:
                    return
                if request.rank <= below:
                    place = self._ask(self._place(request))
                    below = self.requests[place - 1].rank if place else (-inf, 0)

    def _ask(self, place: int) -> int:
        """Ask which drone the request at this place gets; return the least place that this was asked for."""
        if not self.ready or (self._max_airborne is not None and not self.room):
            return place
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

    def _suited(self) -> list[Request]:
        """Return the requests that a ready drone could fly, in their order; where many could, all."""
        suited = set[Request]()
        for drone in self.ready:
            some = self._needs_of(drone).up_to(drone.battery_level, _MANY)
            suited.update(some if len(some) <= _MANY else self.requests)
        return sorted(suited, key=_by_rank, reverse=True)

    def give(self, place: int, choice: Choice | None) -> None:
        """Give the request at this place a drone, if one was chosen."""
        if choice is not None:
            request = self.requests.pop(place)
            drone, request.why = choice
            self.ready.remove(drone)
            put(drone, status=_BUSY)  # at once: no other request may have it
            request.set(drone)

    def refuse(self, request: Request, error: MissionFailed) -> None:
        """Fail a request, and with it its mission."""
        self._drop(request)
        request.fail(error)

    def _drop(self, request: Request) -> None:
        del self.requests[self._place(request)]

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
            if drone.status is not _LOST:
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
            elif self._fresh:
                least = self._needs_of(drone).least(wanted)
                if least < wanted and drone.battery_level >= least:
                    del self.low[drone]
                elif least < wanted:
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
