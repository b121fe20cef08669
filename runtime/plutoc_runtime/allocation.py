"""The fleet's one queue: missions wait in it for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival.

Nobody who waits in vain is looked at again and again: a free drone that is too low for all who wait
is put aside until it is charged, or until somebody comes for whom it is enough.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from heapq import heapify, heappop, heappush
from itertools import compress, islice
from math import inf
from typing import TYPE_CHECKING

from .energy import docked
from .errors import HookFault, MissionFailed
from .kernel import FLEET, Kernel, Kind, Timer
from .policy import BatchPool, Choice, Policy, Pool
from .request import Request
from .status import DroneStatus
from .thresholds import Thresholds

if TYPE_CHECKING:
    from .eligibility import Reach
    from .model import Category, Drone, Trip
    from .trace import Trace

_FREE, _BUSY = DroneStatus.FREE, DroneStatus.BUSY
_LOST = DroneStatus.LOST
_IN_THE_AIR = (_BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)

_IN_VAIN = 16
"""After so many for whom no drone is high enough, it is worth to know for whom one is."""

Entry = tuple[int, int, Request]
"""Priority, higher first; arrival; who waits."""


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
        self._fresh: list[Request] = []
        """Those that have not been served yet."""
        self._waiting = self._arrivals = 0
        self._pools: dict[Policy, Pool] = {}
        self._all_pools: list[Pool] = []
        self._batches: list[BatchPool] = []
        """Those of the pools that look at all trips at once."""
        self._sure: Mapping[Category, float] | None = None
        """Levels with which some drone that is left can surely fly."""
        self._serving = self._serve
        self._high = bytearray(drone.status is _FREE for drone in drones)
        """Which drones are free and in the pools, by their places in the fleet."""
        self._ready = sum(self._high)
        """How many these are."""
        self._low: dict[Drone, float] = {}
        """Free drones that are too low for all that has waited so far, and until when they are."""
        self._gone = self._asked_of = sum(drone.status is _LOST for drone in drones)
        self._airborne = sum(drone.status in _IN_THE_AIR for drone in drones)
        self._thresholds: Thresholds[Request] = Thresholds()
        self._recheck: Timer | None = None
        self._recheck_at = inf
        self.served: Callable[[], None] = lambda: None
        """Called after each serving, while some still wait."""

    def enter(self, trips: Sequence[Trip], policy: Policy, priority: int) -> Request:
        """Wait for a drone for the first trip; the answer comes at the end of this instant or later."""
        pool = self._pools.get(policy)
        if pool is None:
            pool = self._new_pool(policy)
        request = Request(self._reach, trips, pool)
        self._waiting += 1
        self._arrivals = arrival = self._arrivals + 1
        entry = (-priority, arrival, request)
        heappush(self._entries, entry)
        if self._thresholds.kept:
            self._thresholds.add(entry)
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
            self._raise(drone)
        elif before is _FREE:
            self._take(drone)
        if before in _IN_THE_AIR:
            self._airborne -= 1
        if after in _IN_THE_AIR:
            self._airborne += 1
        if after is _LOST or before is _LOST:
            self._gone += (after is _LOST) - (before is _LOST)
            self._sure = None
        if self._waiting:
            self._kernel.last = self._serving

    def freed(self, drone: Drone) -> None:
        """A drone that was BUSY is FREE."""
        self._airborne -= 1
        self._high[drone.index] = True
        self._ready += 1
        for pool in self._all_pools:
            pool.add(drone)
        if self._waiting:
            self._kernel.last = self._serving

    def changed(self) -> None:
        """Something changed: serve the queue at the end of this instant."""
        if self._waiting:
            self._kernel.last = self._serving

    def prioritise(self, trip: Trip, priority: int) -> None:
        """Whoever waits for a drone for this trip has another priority from now on."""
        entries = self._entries
        for place, (_, arrival, request) in enumerate(entries):
            if request.trip is trip and request.waits:
                entries[place] = (-priority, arrival, request)
                heapify(entries)
                self._thresholds.kept.clear()  # it knows them by their old places
                self.changed()
                return

    @property
    def waiting(self) -> bool:
        """Whether anybody waits."""
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
        """The free drones that are of no use to anybody who waits, as they are now."""
        return self._low.keys()

    def too_low(self) -> Iterator[Drone]:
        """Give the free drones that waiting missions could use if they were charged."""
        for drone in sorted(self._low, key=lambda drone: drone.index):
            if any(request.never(drone) is None for request in self.waiters()):
                yield drone

    def waiters(self) -> Iterator[Request]:
        """Give the requests of all who wait."""
        return (request for _, _, request in self._entries if request.waits)

    # The free drones

    def _new_pool(self, policy: Policy) -> Pool:
        pool = self._pools[policy] = policy()
        self._all_pools.append(pool)
        if isinstance(pool, BatchPool):
            self._batches.append(pool)
        for drone in self._ready_drones():
            pool.add(drone)
        return pool

    def _ready_drones(self) -> Iterator[Drone]:
        return compress(self._drones, self._high)

    def _raise(self, drone: Drone) -> None:
        """A drone may be handed out."""
        if not self._high[drone.index]:
            self._high[drone.index] = True
            self._ready += 1
            for pool in self._all_pools:
                pool.add(drone)
        if self._low:
            self._low.pop(drone, None)

    def _take(self, drone: Drone) -> None:
        """A drone may not be handed out."""
        if self._high[drone.index]:
            self._high[drone.index] = False
            self._ready -= 1
            for pool in self._all_pools:
                pool.remove(drone)
        self._low.pop(drone, None)

    # Serving

    def _serve(self) -> None:
        if self._low:
            self._raise_who_is_high_enough()
        if self._ready and self._waiting:
            self._share_out()
        if self._waiting:
            if self._fresh or self._asked_of != self._gone:
                self._refuse_what_cannot_be()
            if self._ready and self.room:
                self._lower_who_is_of_no_use()
            if self._low:
                self._look_again_when_charged()
                self.served()
        elif self._thresholds.kept:
            self._thresholds.kept.clear()
        self._fresh.clear()

    def _share_out(self) -> None:
        entries, most = self._entries, self._max_airborne
        batches = self._batches
        passed: list[Entry] = []
        while entries and self._ready and (most is None or self._airborne < most):
            entry = heappop(entries)
            request = entry[2]
            if request.is_set:
                continue
            if batches and request.pool in batches:
                passed += self._share_among(self._alike(entry))
            elif not self._chosen(request):
                passed.append(entry)
                if len(passed) == _IN_VAIN and not batches:
                    break
        if passed:
            self._put_back(passed)

    def _put_back(self, passed: list[Entry]) -> None:
        """Keep those for whom no drone was high enough, and stop asking them one by one."""
        entries = self._entries
        if len(passed) > _IN_VAIN:
            entries += passed
            heapify(entries)
        else:
            for entry in passed:
                heappush(entries, entry)
        if len(passed) == _IN_VAIN and not self._batches:
            self._share_out_to_the_able(passed)

    def _share_out_to_the_able(self, asked: Sequence[Entry]) -> None:
        """Go on, among those not asked yet, with those alone for whom a drone is high enough."""
        able = {
            entry[1]: entry
            for drone in self._ready_drones()
            for entry in self._thresholds.met(drone, self._entries)
        }
        for entry in asked:
            able.pop(entry[1], None)
        for entry in sorted(able.values()):
            if not self._ready or not self.room:
                break
            self._chosen(entry[2])
        if len(self._entries) > 2 * self._waiting + _IN_VAIN:
            self._entries = [entry for entry in self._entries if entry[2].waits]
            heapify(self._entries)

    def _chosen(self, request: Request) -> bool:
        """Let the policy choose; say whether the request is over."""
        try:
            choice = request.pool.choose(request.trip, request.able)
        except HookFault as fault:
            self._refuse(request, fault)
            return True
        if choice is None:
            return False
        self._give(request, choice)
        return True

    def _alike(self, entry: Entry) -> list[Entry]:
        """Take the entries that come next and have the same priority and policy."""
        entries, alike, taken = self._entries, [entry], 0
        entries.sort()  # it is a heap still
        for following in entries:
            request = following[2]
            if request.waits:
                if following[0] != entry[0] or request.pool is not entry[2].pool:
                    break
                alike.append(following)
            taken += 1
        del entries[:taken]
        return alike

    def _share_among(self, entries: Sequence[Entry]) -> list[Entry]:
        """Let the policy choose for all of them at once; return those that got nothing."""
        pool = next(batch for batch in self._batches if batch is entries[0][2].pool)
        offers = [(entry[2].trip, entry[2].able) for entry in entries]
        passed: list[Entry] = []
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
        self._high[drone.index] = False
        self._ready -= 1
        for pool in self._all_pools:
            pool.remove(drone)
        drone.status = _BUSY  # at once: nobody else may have it
        request.set(drone)

    def _refuse(self, request: Request, error: MissionFailed) -> None:
        self._waiting -= 1
        request.fail(error)

    def _refuse_what_cannot_be(self) -> None:
        """Refuse those who have come, and after a loss all who wait, if no drone is able."""
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

    # Who is too low

    def _raise_who_is_high_enough(self) -> None:
        """Those that have charged, and those that are high enough for somebody who has come."""
        now = self._kernel.now
        fresh = [request for request in self._fresh if request.waits]
        for drone, until in list(self._low.items()):
            if until <= now or any(request.able(drone) for request in fresh):
                self._raise(drone)
            elif fresh:
                least = min(request.level(drone) for request in fresh)
                self._low[drone] = min(until, now + _charging(drone, least))

    def _lower_who_is_of_no_use(self) -> None:
        """A docked drone that is too low for what waits will be high enough at a known time.

        One that is high enough and was not given (no more may fly, a policy wants it not) stays so.
        """
        now = self._kernel.now
        for drone in list(self._ready_drones()):
            if not any(request.able(drone) for request in islice(self.waiters(), _IN_VAIN)):
                until = now + _charging(drone, self._thresholds.least(drone, self._entries))
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
