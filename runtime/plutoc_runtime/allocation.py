"""The fleet's one queue: missions wait in it for a drone.

It is served at the end of every instant in which something changed, so that all requests and all
free drones of the instant are known: by priority, higher first, then by arrival.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby

from .eligibility import Eligibility
from .errors import MissionFailed
from .kernel import FLEET, Kernel, Kind, Signal, Timer
from .model import Drone, Trip
from .policy import Decision, Offer, Policy
from .status import DroneStatus

_GONE = (DroneStatus.LOST, DroneStatus.OFFLINE)
_IN_THE_AIR = (DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)


class Request:
    """A mission that waits for a drone."""

    def __init__(self, chain: Sequence[Trip], policy: Policy, priority: int, arrival: int) -> None:
        self.chain, self.policy, self.priority, self.arrival = chain, policy, priority, arrival
        self.answer: Signal[Decision] = Signal()
        self.waits_because = ""


class Queue:
    """The missions that wait, and the drones that they wait for."""

    def __init__(
        self,
        kernel: Kernel,
        drones: Sequence[Drone],
        eligibility: Eligibility,
        max_airborne: int | None,
    ) -> None:
        self._kernel, self._drones, self._eligibility = kernel, drones, eligibility
        self._max_airborne = max_airborne
        self._requests: list[Request] = []
        self._arrivals = 0
        self.served: Callable[[], None] = lambda: None
        """Called after each serving, while some still wait."""
        self._round: Timer | None = None
        self._recheck: Timer | None = None

    def enter(self, chain: Sequence[Trip], policy: Policy, priority: int) -> Request:
        """Wait for a drone; the answer comes at the end of this instant or later."""
        self._arrivals += 1
        request = Request(chain, policy, priority, self._arrivals)
        self._requests.append(request)
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

    def too_low(self) -> list[Drone]:
        """Return the free drones that waiting missions could use if they were charged."""
        return [
            drone
            for drone in self._drones
            if drone.status is DroneStatus.FREE
            and any(
                self._eligibility.never(drone, request.chain) is None
                and drone.battery_level < self._eligibility.battery(drone, request.chain)
                for request in self._requests
            )
        ]

    def _serve(self) -> None:
        self._refuse_what_cannot_be()
        places = self._places()
        free = [drone for drone in self._drones if drone.status is DroneStatus.FREE]
        order = sorted(self._requests, key=lambda request: (-request.priority, request.arrival))
        for _, group in groupby(order, key=lambda request: (request.priority, request.policy)):
            requests = list(group)
            offers = [self._offer(request, free) for request in requests]
            by_offer = dict(zip(offers, requests, strict=True))
            for decision in requests[0].policy(offers):
                if decision.fault is None:
                    if places == 0:
                        continue
                    places -= 1
                    free = [drone for drone in free if drone is not decision.drone]
                self._answer(by_offer[decision.offer], decision)
        self._explain()
        self._look_again_when_charged()
        if self._requests:
            self.served()

    def _answer(self, request: Request, decision: Decision) -> None:
        self.leave(request)
        if decision.fault is not None:
            request.answer.fail(decision.fault)
        elif decision.drone is not None:
            decision.drone.status = DroneStatus.BUSY  # at once: nobody else may have it
            request.answer.set(decision)

    def _offer(self, request: Request, free: Sequence[Drone]) -> Offer:
        candidates = tuple(
            drone
            for drone in free
            if self._eligibility.never(drone, request.chain) is None
            and drone.battery_level >= self._eligibility.battery(drone, request.chain)
        )
        return Offer(trip=request.chain[0], candidates=candidates)

    def _places(self) -> int:
        """How many more drones may fly."""
        if self._max_airborne is None:
            return len(self._drones)
        airborne = sum(drone.status in _IN_THE_AIR for drone in self._drones)
        return max(0, self._max_airborne - airborne)

    def _refuse_what_cannot_be(self) -> None:
        for request in list(self._requests):
            left = [drone for drone in self._drones if drone.status not in _GONE]
            reasons = [self._eligibility.never(drone, request.chain) for drone in left]
            if None not in reasons:
                self.leave(request)
                why = "; ".join(dict.fromkeys(reason for reason in reasons if reason))
                gone = len(self._drones) - len(left)
                lost = f"{gone} of {len(self._drones)} drones are lost" if gone else ""
                because = "; ".join(part for part in (lost, why) if part)
                request.answer.fail(
                    MissionFailed(
                        f"no drone of the fleet can fly trip {request.chain[0].name}: {because}"
                    )
                )

    def _explain(self) -> None:
        """Keep for each mission why it waits."""
        count = dict.fromkeys(DroneStatus, 0)
        for drone in self._drones:
            count[drone.status] += 1
        standing = ", ".join(
            f"{number} {status.value.lower()}" for status, number in count.items() if number
        )
        for request in self._requests:
            request.waits_because = f"waits for a drone ({standing})"

    def _look_again_when_charged(self) -> None:
        """A docked drone that is too low for what waits will be high enough at a known time."""
        soonest: float | None = None
        for request in self._requests:
            for drone in self._drones:
                if drone.status not in (DroneStatus.FREE, DroneStatus.CHARGING):
                    continue
                if self._eligibility.never(drone, request.chain) is not None:
                    continue
                missing = self._eligibility.battery(drone, request.chain) - drone.battery_level
                if missing > 0:
                    seconds = missing * drone.category.charge_time + 0.001
                    soonest = seconds if soonest is None else min(soonest, seconds)
        if self._recheck is not None:
            self._recheck.cancel()
            self._recheck = None
        if soonest is not None:
            self._recheck = self._kernel.at(
                self._kernel.now + soonest, Kind.CLOCK, FLEET, self.changed
            )
