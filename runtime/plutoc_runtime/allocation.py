"""The fleet's one queue: missions wait in it for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival.
"""

from __future__ import annotations

from bisect import insort
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import groupby
from math import inf
from typing import TYPE_CHECKING

from .eligibility import Demand
from .energy import docked
from .errors import MissionFailed
from .kernel import FLEET, Kernel, Kind, Signal, Timer
from .policy import Decision, Offer, Policy
from .status import DroneStatus

if TYPE_CHECKING:
    from .airspace import Airspace
    from .app import App
    from .model import Drone, Trip

_GONE = (DroneStatus.LOST, DroneStatus.OFFLINE)
_IN_THE_AIR = (DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)


class Request:
    """A mission that waits for a drone."""

    def __init__(self, demand: Demand, policy: Policy, priority: int, arrival: int) -> None:
        self.demand, self.policy, self.priority = demand, policy, priority
        self.place = (-priority, arrival)
        self.answer: Signal[Decision] = Signal()
        self.fresh = True
        """It has not been served yet."""
        self.refused_of = -1
        """How many drones were lost when it was last asked whether any drone is able."""


class Queue:
    """The missions that wait, and the drones that they wait for."""

    def __init__(
        self,
        kernel: Kernel,
        app: App,
        airspace: Airspace,
        drones: Sequence[Drone],
        max_airborne: int | None,
    ) -> None:
        self._kernel, self._app, self._airspace = kernel, app, airspace
        self._drones, self._max_airborne = drones, max_airborne
        self._requests: list[Request] = []
        self._arrivals = 0
        self.served: Callable[[], None] = lambda: None
        """Called after each serving, while some still wait."""
        self._round: Timer | None = None
        self._recheck: Timer | None = None
        self._low: dict[Drone, float] = {}
        """Free drones that are too low for all that has waited so far, and until when they are."""

    def enter(self, chain: Sequence[Trip], policy: Policy, priority: int) -> Request:
        """Wait for a drone; the answer comes at the end of this instant or later."""
        self._arrivals += 1
        demand = Demand(self._app, self._airspace, chain)
        request = Request(demand, policy, priority, self._arrivals)
        insort(self._requests, request, key=lambda request: request.place)
        self.changed()
        return request

    def leave(self, request: Request) -> None:
        """Do not wait any longer."""
        if request in self._requests:
            self._requests.remove(request)

    def changed(self) -> None:
        """Something changed: serve the queue at the end of this instant."""
        if self._requests and (self._round is None or self._round.call is None):
            self._round = self._kernel.at(self._kernel.now, Kind.ALLOCATE, FLEET, self._serve)

    @property
    def waiting(self) -> bool:
        """Whether anybody waits."""
        return bool(self._requests)

    def standing(self) -> str:
        """Say what the drones are doing: why a mission waits."""
        count = Counter(drone.status for drone in self._drones)
        return ", ".join(f"{count[s]} {s.value.lower()}" for s in DroneStatus if count[s])

    @property
    def room(self) -> bool:
        """Whether one more drone may fly."""
        return self._places() > 0

    def too_low(self) -> Iterator[Drone]:
        """Give the free drones that waiting missions could use if they were charged."""
        for drone in self._free():
            if any(request.demand.never(drone) is None for request in self._requests):
                yield drone

    def _free(self) -> list[Drone]:
        return [drone for drone in self._drones if drone.status is DroneStatus.FREE]

    def _serve(self) -> None:
        self._refuse_what_cannot_be()
        free, places = self._free(), self._places()
        self._low = {drone: until for drone, until in self._low.items() if drone in free}
        high = [drone for drone in free if self._low.get(drone, 0.0) <= self._kernel.now]
        waiting = groupby(self._requests[:], key=lambda request: (request.priority, request.policy))
        for (_, policy), requests in waiting:
            asked: dict[Offer, Request] = {}
            for decision in policy(_offers(requests, free, high, asked)):
                if decision.drone is not None:
                    if places == 0:
                        break
                    places -= 1
                    free.remove(decision.drone)
                    if decision.drone in high:
                        high.remove(decision.drone)
                self._answer(asked[decision.offer], decision)
            if not free or places == 0:
                break
        self._look_again_when_charged(free, high)
        if self._requests:
            self.served()

    def _answer(self, request: Request, decision: Decision) -> None:
        self.leave(request)
        if decision.fault is not None:
            request.answer.fail(decision.fault)
        elif decision.drone is not None:
            decision.drone.status = DroneStatus.BUSY  # at once: nobody else may have it
            request.answer.set(decision)

    def _places(self) -> int:
        """Return how many more drones may fly."""
        if self._max_airborne is None:
            return len(self._drones)
        airborne = sum(drone.status in _IN_THE_AIR for drone in self._drones)
        return max(0, self._max_airborne - airborne)

    def _refuse_what_cannot_be(self) -> None:
        left = [drone for drone in self._drones if drone.status not in _GONE]
        gone = len(self._drones) - len(left)
        for request in self._requests[:]:
            if request.refused_of == gone:
                continue
            request.refused_of = gone
            reasons = [request.demand.never(drone) for drone in left]
            if None not in reasons:
                self.leave(request)
                lost = [f"{gone} of {len(self._drones)} drones are lost"] if gone else []
                because = "; ".join([*lost, *dict.fromkeys(reason for reason in reasons if reason)])
                trip = request.demand.chain[0].name
                request.answer.fail(
                    MissionFailed(f"no drone of the fleet can fly trip {trip}: {because}")
                )

    def _look_again_when_charged(self, free: Iterable[Drone], high: Sequence[Drone]) -> None:
        """A docked drone that is too low for what waits will be high enough at a known time.

        One that is high enough and was not given (no more may fly, a policy wants it not) stays so.
        """
        fresh = [request for request in self._requests if request.fresh]
        for drone in free:
            known, asking = (inf, self._requests) if drone in high else (self._low[drone], fresh)
            waits = [self._kernel.now + _charging(drone, request.demand) for request in asking]
            self._low[drone] = min([known, *waits])
        for request in fresh:
            request.fresh = False
        if self._recheck is not None:
            self._recheck.cancel()
        later = (until for until in self._low.values() if until > self._kernel.now)
        soonest = min(later, default=inf)
        if soonest < inf:
            self._recheck = self._kernel.at(soonest, Kind.CLOCK, FLEET, self.changed)


def _offers(
    requests: Iterable[Request], free: list[Drone], high: list[Drone], asked: dict[Offer, Request]
) -> Iterator[Offer]:
    """Give what each mission is offered of the drones that are left when it is asked.

    Of all that are free only a mission that has just come needs to look at those that are too low
    for the others.
    """
    for request in requests:
        drones = free if request.fresh else high
        candidates = tuple(drone for drone in drones if request.demand.met_by(drone))
        if candidates:
            offer = Offer(trip=request.demand.chain[0], candidates=candidates)
            asked[offer] = request
            yield offer


def _charging(drone: Drone, demand: Demand) -> float:
    """Return the seconds until a drone in its dock has charged enough; never: infinite."""
    if demand.never(drone) is not None:
        return inf
    missing = demand.battery(drone) - drone.battery_level
    if missing <= 0:
        return 0.0
    charges = docked(drone.location, drone.home)
    return missing * drone.category.charge_time + 0.001 if charges else inf
