"""The queue in which missions wait for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival. A free drone that
is too low for all who wait is put aside until it is charged, or until it is high enough for a new one.
"""

from __future__ import annotations

from bisect import insort
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from math import inf
from operator import attrgetter
from typing import TYPE_CHECKING

from ..domain.errors import HookFault, MissionFailed
from ..domain.status import DroneStatus
from ..time.future import Future
from ..time.kernel import FLEET, EventKind, Kernel, Timer
from .policies import Batch, Choice, Policy
from .reach import Reach, chain_of, docked, needed, stops_of, why_not

if TYPE_CHECKING:
    from ..domain.model import Category, Drone, Point, Trip

_FREE, _BUSY, _LOST = DroneStatus.FREE, DroneStatus.BUSY, DroneStatus.LOST
_IN_THE_AIR = (_BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)

_in_the_file = attrgetter("index")


class Request(Future["Drone"]):
    """A mission's request for a drone; as a future it is set to the drone that it gets."""

    __slots__ = ("_levels", "_reach", "_surely", "_trips", "policy", "trip", "why")

    def __init__(self, reach: Reach, trips: Sequence[Trip], policy: Policy) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.trip, self.policy = trips[0], policy
        self.why = ""
        """Why its drone was chosen."""
        self._reach, self._trips, self._surely = reach, trips, reach.levels(trips[0])
        self._levels: dict[tuple[Category, Point, Point], float] = {}

    def able(self, drone: Drone) -> bool:
        """Return whether a drone can fly the trip now."""
        level = drone.telemetry.battery_level
        return level >= self._surely[drone.category] or level >= self.level(drone)

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with a full battery; None: it can."""
        if self._surely[drone.category] <= 1.0:
            return None
        app, airspace, chain = self._reach.app, self._reach.airspace, chain_of(self._trips)
        return why_not(app, airspace, drone.category, drone.home, chain)

    def level(self, drone: Drone) -> float:
        """Return the battery level that a drone needs from where it stands; infinite: it never suffices."""
        key = category, home, here = drone.category, drone.home, drone.location
        if key not in self._levels:
            part, airspace = None, self._reach.airspace
            if self.never(drone) is None:
                stops = stops_of(
                    self._reach.app, category, airspace.cruise_height, chain_of(self._trips)
                )
                part = needed(category, airspace, here, stops, home)
            self._levels[key] = inf if part is None else part + category.reserve
        return self._levels[key]


class Queue:
    """The waiting requests, and the free drones."""

    def __init__(
        self, kernel: Kernel, reach: Reach, drones: Sequence[Drone], max_airborne: int | None
    ) -> None:
        self._kernel, self._reach = kernel, reach
        self._drones, self._max_airborne = drones, max_airborne
        self._entries: list[tuple[int, int, Request]] = []
        """Sorted, the last is served first: (priority, minus the arrival number, request)."""
        self._fresh: list[Request] = []
        """The requests that have not been looked at yet."""
        self._arrivals = 0
        self._ready: list[Drone] = []
        """While it is served: the free drones that may be chosen, in the fleet's order."""
        self._low: dict[Drone, float] = {}
        """The other free drones: too low for every request so far, and until when."""
        self._one_is_lost = False
        """Whether a drone has been lost since the requests were last checked."""
        self._recheck: Timer | None = None
        self._recheck_at = inf
        self.served: Callable[[], None] = lambda: None
        """Called after each serving, while some still wait."""

    def enter(self, trips: Sequence[Trip], policy: Policy, priority: int) -> Request:
        """Request a drone for the first trip; it is given at the end of this instant or later."""
        rank = +priority  # raises here, in its mission, if a hook has left something odd there
        request = Request(self._reach, trips, policy)
        self._arrivals += 1
        insort(self._entries, (rank, -self._arrivals, request))
        self._fresh.append(request)
        self._kernel.at_the_end = self._serve
        return request

    def leave(self, request: Request) -> None:
        """Withdraw a request."""
        self._drop(request)
        request.is_set = True

    def moved(self, drone: Drone) -> None:
        """Called when a drone's status was set: serve the queue at the end of this instant."""
        self._low.pop(drone, None)
        if drone.status is _LOST:
            self._one_is_lost = True
        self.changed()

    def changed(self) -> None:
        """Serve the queue at the end of this instant."""
        if self._entries:
            self._kernel.at_the_end = self._serve

    def prioritise(self, trip: Trip, priority: int) -> None:
        """Change the priority of the request for this trip."""
        for place, (_, arrival, request) in enumerate(self._entries):
            if request.trip is trip:
                self._entries[place] = (priority, arrival, request)
                self._entries.sort()
                self.changed()
                return

    @property
    def waiting(self) -> bool:
        """Whether any request waits."""
        return bool(self._entries)

    def summary(self) -> str:
        """Return a summary of what the drones are doing: why a mission waits."""
        count = Counter(drone.status for drone in self._drones)
        return ", ".join(f"{count[s]} {s.value.lower()}" for s in DroneStatus if count[s])

    @property
    def room(self) -> bool:
        """Whether one more drone may fly."""
        most = self._max_airborne
        return most is None or sum(drone.status in _IN_THE_AIR for drone in self._drones) < most

    @property
    def low(self) -> Collection[Drone]:
        """The free drones whose batteries are too low for every request."""
        return self._low.keys()

    def too_low(self) -> Iterator[Drone]:
        """Yield the free drones that waiting missions could use if they were charged."""
        for drone in sorted(self._low, key=_in_the_file):
            if any(request.never(drone) is None for request in self.waiters()):
                yield drone

    def waiters(self) -> Iterator[Request]:
        """Yield the waiting requests."""
        return (request for _, _, request in reversed(self._entries))

    # Serving

    def _serve(self) -> None:
        if self._low:
            self._put_back_the_charged()
        low = self._low
        self._ready = [one for one in self._drones if one.status is _FREE and one not in low]
        self._share_out()
        if self._entries:
            self._refuse_what_cannot_be()
            if self._ready and self.room:
                self._put_aside_the_low()
            if self._low:
                self._look_again_when_charged()
                self.served()
        self._fresh.clear()

    def _share_out(self) -> None:
        place = len(self._entries)
        while place and self._ready and self.room:
            place -= 1
            request = self._entries[place][2]
            if isinstance(request.policy, Batch):
                place = self._share_among(place, request.policy)
            else:
                try:
                    choice = request.policy(request.trip, self._ready, request.able)
                except HookFault as fault:
                    self._refuse(request, fault)
                else:
                    self._give(request, choice)

    def _share_among(self, last: int, policy: Batch) -> int:
        """Serve together the request at this index and all before it of the same policy and priority.

        Return the index of the first of them.
        """
        first, (priority, _, _) = last, self._entries[last]
        while first:
            before, _, request = self._entries[first - 1]
            if before != priority or request.policy is not policy:
                break
            first -= 1
        requests = [request for _, _, request in reversed(self._entries[first : last + 1])]
        offers = [(request.trip, request.able) for request in requests]
        for request, choice in zip(requests, policy(offers, self._ready), strict=True):
            if self.room:
                self._give(request, choice)
        return first

    def _give(self, request: Request, choice: Choice | None) -> None:
        if choice is not None:
            drone, request.why = choice
            self._drop(request)
            self._ready.remove(drone)
            drone.status = _BUSY  # at once: no other request may have it
            request.set(drone)

    def _refuse(self, request: Request, error: MissionFailed) -> None:
        self._drop(request)
        request.fail(error)

    def _drop(self, request: Request) -> None:
        place = len(self._entries) - 1
        while self._entries[place][2] is not request:  # most that leave are the next to be served
            place -= 1
        del self._entries[place]

    def _refuse_what_cannot_be(self) -> None:
        """Refuse requests that no drone can serve: new ones, and all after the loss of a drone."""
        asked = tuple(self.waiters()) if self._one_is_lost else self._fresh
        self._one_is_lost = False
        for request in asked:
            if not request.is_set and (why := self._never(request)) is not None:
                lacking = f"no drone of the fleet can fly trip {request.trip.name}: {why}"
                self._refuse(request, MissionFailed(lacking))

    def _never(self, request: Request) -> str | None:
        """Return why none of the drones that are left can ever fly a trip; None: one can."""
        reasons: list[str] = []
        for drone in self._drones:
            if drone.status is not _LOST:
                why = request.never(drone)
                if why is None:
                    return None
                reasons.append(why)
        if lost := len(self._drones) - len(reasons):
            reasons.insert(0, f"{lost} of {len(self._drones)} drones are lost")
        return "; ".join(dict.fromkeys(reasons))

    # Drones that are too low

    def _put_back_the_charged(self) -> None:
        """Make drones ready again that have charged, or that suffice for a new request."""
        fresh = [request for request in self._fresh if not request.is_set]
        for drone, until in list(self._low.items()):
            if until <= self._kernel.now or any(request.able(drone) for request in fresh):
                del self._low[drone]
            else:
                self._low[drone] = min(until, self._charged(drone, fresh))

    def _put_aside_the_low(self) -> None:
        """Put drones aside that are too low for every request; a docked one until it has charged.

        A drone that suffices and was not chosen (by a policy, or as no more may fly) stays ready.
        """
        for drone in self._ready:
            if not any(request.able(drone) for request in self.waiters()):
                self._low[drone] = self._charged(drone, self.waiters())

    def _charged(self, drone: Drone, requests: Iterable[Request]) -> float:
        """Return when a drone suffices for one of them where it stands; infinite: it never will."""
        level = min((request.level(drone) for request in requests), default=inf)
        if level == inf or not docked(drone.location, drone.home):
            return inf
        return self._kernel.now + (drone.charging(level) + 0.001)

    def _look_again_when_charged(self) -> None:
        soonest = min(self._low.values())
        if soonest == self._recheck_at:
            return
        if self._recheck is not None:
            self._recheck.cancel()
        self._recheck_at, self._recheck = soonest, None
        if soonest < inf:
            self._recheck = self._kernel.at(soonest, EventKind.CLOCK, FLEET, self.changed)
