"""The fleet's one queue: missions wait in it for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival. A free drone that
is too low for all who wait is put aside until it is charged, or until it is high enough for a new one.
"""

from __future__ import annotations

from bisect import insort
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING

from .energy import docked
from .errors import HookFault, MissionFailed
from .kernel import FLEET, Kernel, Kind, Timer
from .policy import BatchPool, Choice, Policy, Pool
from .request import Request
from .status import DroneStatus

if TYPE_CHECKING:
    from .eligibility import Reach
    from .model import Category, Drone, Trip
    from .trace import Trace

_FREE, _BUSY = DroneStatus.FREE, DroneStatus.BUSY
_LOST = DroneStatus.LOST
_IN_THE_AIR = (_BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)

Entry = tuple[int, int, Request]
"""Priority; arrival, below 0, so that the latest is least; the request."""


class Queue:
    """The missions that wait, and the drones that they wait for."""

    def __init__(
        self,
        kernel: Kernel,
        trace: Trace,
        reach: Reach,
        drones: Sequence[Drone],
        max_airborne: int | None,
    ) -> None:
        self._kernel, self._trace, self._reach = kernel, trace, reach
        self._drones, self._max_airborne = drones, max_airborne
        self._entries: list[Entry] = []
        """In order, the last is served first; those that no longer wait are dropped then."""
        self._fresh: list[Request] = []
        """Those that have not been served yet."""
        self._waiting = self._arrivals = 0
        self._pools: dict[Policy, Pool] = {}
        self._batches: dict[Pool, BatchPool] = {}
        """Those of the pools that look at all trips at once."""
        self._sure: Mapping[Category, float] | None = None
        """Levels with which some drone that is left can surely fly."""
        self._serving = self._serve
        self._ready = {drone: None for drone in drones if drone.status is _FREE}
        """The drones that are free and in the pools."""
        self._low: dict[Drone, float] = {}
        """Free drones that are too low for all that has waited so far, and until when they are."""
        self._gone = self._asked_of = sum(drone.status is _LOST for drone in drones)
        self._airborne = sum(drone.status in _IN_THE_AIR for drone in drones)
        self._recheck: Timer | None = None
        self._recheck_at = inf
        self.served: Callable[[], None] = lambda: None
        """Called after each serving, while some still wait."""

    def enter(self, trips: Sequence[Trip], policy: Policy, priority: int) -> Request:
        """Wait for a drone for the first trip; the answer comes at the end of this instant or later."""
        rank = +priority  # raises here, in its mission, if a hook has left something odd there
        pool = self._pools.get(policy)
        if pool is None:
            pool = self._pools[policy] = policy()
            if isinstance(pool, BatchPool):
                self._batches[pool] = pool
            for drone in self._ready:
                pool.add(drone)
        request = Request(self._reach, trips, pool)
        self._waiting += 1
        self._arrivals += 1
        insort(self._entries, (rank, -self._arrivals, request))
        if self._low or request.levels is not self._sure:
            self._fresh.append(request)
        self._kernel.last = self._serving
        return request

    def leave(self, request: Request) -> None:
        """Do not wait any longer."""
        if not request.is_set:
            request.is_set = True
            self._waiting -= 1

    def moved(self, drone: Drone, before: DroneStatus, after: DroneStatus) -> None:
        """A drone has changed its status: serve the queue at the end of this instant."""
        if after is _FREE:
            self._low.pop(drone, None)
            self._put(drone)
        elif before is _FREE:
            self._low.pop(drone, None)
            self._take(drone)
        self._airborne += (after in _IN_THE_AIR) - (before in _IN_THE_AIR)
        if after is _LOST or before is _LOST:
            self._gone += (after is _LOST) - (before is _LOST)
            self._sure = None
        self.changed()

    def freed(self, drone: Drone) -> None:
        """A drone that was BUSY is FREE."""
        self._airborne -= 1
        self._put(drone)
        self.changed()

    def changed(self) -> None:
        """Something changed: serve the queue at the end of this instant."""
        if self._waiting:
            self._kernel.last = self._serving

    def prioritise(self, trip: Trip, priority: int) -> None:
        """The request for this trip has another priority from now on."""
        for place, (_, arrival, request) in enumerate(self._entries):
            if request.trip is trip and request.waits:
                self._entries[place] = (priority, arrival, request)
                self._entries.sort()
                self.changed()
                return

    @property
    def waiting(self) -> bool:
        """Whether any request waits."""
        return self._waiting > 0

    def standing(self) -> str:
        """Say what the drones are doing: why a mission waits."""
        count = Counter(drone.status for drone in self._drones)
        return ", ".join(f"{count[s]} {s.value.lower()}" for s in DroneStatus if count[s])

    @property
    def room(self) -> bool:
        """Whether one more drone may fly."""
        return self._max_airborne is None or self._airborne < self._max_airborne

    @property
    def low(self) -> Collection[Drone]:
        """The free drones that no request can use, as they are now."""
        return self._low.keys()

    def too_low(self) -> Iterator[Drone]:
        """Give the free drones that waiting missions could use if they were charged."""
        for drone in sorted(self._low, key=lambda drone: drone.index):
            if any(request.never(drone) is None for request in self.waiters()):
                yield drone

    def waiters(self) -> Iterator[Request]:
        """Give the requests that wait."""
        return (request for _, _, request in reversed(self._entries) if request.waits)

    # The free drones

    def _put(self, drone: Drone) -> None:
        """A drone may be handed out."""
        if drone not in self._ready:
            self._ready[drone] = None
            for pool in self._pools.values():
                pool.add(drone)

    def _take(self, drone: Drone) -> None:
        """A drone may not be handed out."""
        if drone in self._ready:
            del self._ready[drone]
            for pool in self._pools.values():
                pool.remove(drone)

    # Serving

    def _serve(self) -> None:
        if self._low:
            self._put_back_the_charged()
        if self._ready and self._waiting:
            self._share_out()
        if self._waiting:
            if self._fresh or self._asked_of != self._gone:
                self._refuse_what_cannot_be()
            if self._ready and self.room:
                self._put_aside_the_low()
            if self._low:
                self._look_again_when_charged()
                self.served()
        self._fresh.clear()

    def _share_out(self) -> None:
        passed: list[Entry] = []
        while self._entries and self._ready and self.room:
            entry = self._entries.pop()
            request = entry[2]
            if request.is_set:
                continue
            batch = self._batches.get(request.pool)
            if batch is not None:
                passed += self._share_among(self._alike(entry), batch)
            elif not self._chosen(request):
                passed.append(entry)
        if passed:
            self._entries += reversed(passed)

    def _chosen(self, request: Request) -> bool:
        """Let the policy choose; say whether the request is over."""
        try:
            choice = request.pool.choose(request.trip, request.able)
        except HookFault as fault:
            self._refuse(request, fault)
            return True
        if choice is not None:
            self._give(request, choice)
        return choice is not None

    def _alike(self, first: Entry) -> list[Entry]:
        """Take the entries that come next and have the same priority and policy."""
        alike, entries = [first], self._entries
        while entries:
            priority, _, request = entries[-1]
            if request.waits:
                if (priority, request.pool) != (first[0], first[2].pool):
                    break
                alike.append(entries[-1])
            entries.pop()
        return alike

    def _share_among(self, entries: Sequence[Entry], pool: BatchPool) -> list[Entry]:
        """Let the policy choose for all of them at once; return those that got nothing."""
        passed: list[Entry] = []
        offers = [(request.trip, request.able) for _, _, request in entries]
        for entry, choice in zip(entries, pool.share(offers), strict=True):
            if choice is None or not self.room:
                passed.append(entry)
            else:
                self._give(entry[2], choice)
        return passed

    def _give(self, request: Request, choice: Choice) -> None:
        drone, why = choice
        if self._trace.live:
            request.why = why()
        self._waiting -= 1
        self._airborne += 1
        self._take(drone)
        drone.status = _BUSY  # at once: no other request may have it
        request.set(drone)

    def _refuse(self, request: Request, error: MissionFailed) -> None:
        self._waiting -= 1
        request.fail(error)

    def _refuse_what_cannot_be(self) -> None:
        """Refuse new requests, and after a loss all that wait, if no drone is able."""
        asked = self._fresh if self._asked_of == self._gone else list(self.waiters())
        self._asked_of = self._gone
        for request in asked:
            if not request.is_set and not self._any_able(request):
                self._refuse(request, self._unable(request))

    def _any_able(self, request: Request) -> bool:
        for drone in self._drones:
            if drone.status is not _LOST and request.never(drone) is None:
                if request.levels[drone.category] <= 1.0:
                    self._sure = request.levels
                return True
        return False

    def _unable(self, request: Request) -> MissionFailed:
        lost = [f"{self._gone} of {len(self._drones)} drones are lost"] if self._gone else []
        left = (drone for drone in self._drones if drone.status is not _LOST)
        reasons = (request.never(drone) for drone in left)
        because = "; ".join([*lost, *dict.fromkeys(reason for reason in reasons if reason)])
        return MissionFailed(f"no drone of the fleet can fly trip {request.trip.name}: {because}")

    # Drones that are too low

    def _put_back_the_charged(self) -> None:
        """Those that have charged, and those that are high enough for a new request."""
        now = self._kernel.now
        fresh = [request for request in self._fresh if request.waits]
        for drone, until in list(self._low.items()):
            if until <= now or any(request.able(drone) for request in fresh):
                del self._low[drone]
                self._put(drone)
            elif fresh:
                least = min(request.level(drone) for request in fresh)
                self._low[drone] = min(until, now + _charging(drone, least))

    def _put_aside_the_low(self) -> None:
        """A docked drone that is too low for what waits will be high enough at a known time.

        One that is high enough and was not given (no more may fly, a policy wants it not) stays.
        """
        now = self._kernel.now
        for drone in list(self._ready):
            if not any(request.able(drone) for request in self.waiters()):
                least = min((one.level(drone) for one in self.waiters()), default=inf)
                until = now + _charging(drone, least)
                if until > now:
                    self._take(drone)
                    self._low[drone] = until

    def _look_again_when_charged(self) -> None:
        soonest = min(self._low.values())
        if soonest != self._recheck_at or self._recheck is None:
            if self._recheck is not None:
                self._recheck.cancel()
            self._recheck_at, self._recheck = soonest, None
            if soonest < inf:
                self._recheck = self._kernel.at(soonest, Kind.CLOCK, FLEET, self._checked_again)

    def _checked_again(self) -> None:
        self._recheck = None
        self.changed()


def _charging(drone: Drone, level: float) -> float:
    """Return the seconds until a drone in its dock has charged so far; never: infinite."""
    missing = level - drone.battery_level
    if missing <= 0:
        return 0.0
    charges = level < inf and docked(drone.location, drone.home)
    return missing * drone.category.charge_time + 0.001 if charges else inf
