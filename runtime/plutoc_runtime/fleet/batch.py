"""Policies that choose for all waiting trips of one priority at once, and pass over none for ever.

A trip that has waited for `OLD` seconds goes before all younger ones: it gets the nearest drone that can fly it.
If all are too low, as near trips keep them low, one is put aside until it is charged for it.
"""

from __future__ import annotations

from functools import update_wrapper
from typing import TYPE_CHECKING, Any

from .policies import nearest

if TYPE_CHECKING:
    from .policies import Policy
    from .queue import Queue, Request

OLD = 1_800.0


class Batch:
    """Decorates a policy: of requests, in the order of their arrival, free drones and the queue.

    It returns a `Choice` or None for each. One `of` a hook may let trips wait as long as the hook wants.
    """

    def __init__(self, policy: Policy, of: object = None) -> None:
        self._policy = policy
        self._ages = of is None
        self.asks = policy if of is None else of
        update_wrapper(self, policy)

    def __call__(self, *given: Any) -> Any:
        """Ask the policy."""
        return self._policy(*given)

    def share(self, queue: Queue, place: int) -> int:
        """Serve a request, and all around it of its policy and priority; return the place of the last."""
        waiting = queue.requests
        request = waiting[place]
        if self._ages and queue.kernel.now - request.since >= OLD:
            queue.give(place, nearest(request.trip, queue.ready, request.able))
            if not request.is_set:
                self._charge_one_for(request, queue)
            return place

        def alike(other: Request) -> bool:
            asks = getattr(other.policy, "asks", None)
            return asks is self.asks and other.rank[0] == request.rank[0]

        first = place
        while first and alike(waiting[first - 1]):
            first -= 1
        while place + 1 < len(waiting) and alike(waiting[place + 1]):
            place += 1
        places = range(place, first - 1, -1)
        choices = self._policy([waiting[each] for each in places], queue.ready, queue)
        for each, choice in zip(places, choices, strict=True):
            queue.give(each, choice)
        return first

    def _charge_one_for(self, request: Request, queue: Queue) -> None:
        """Put the drone aside that has the most in its battery, for no other request, unless one is already."""
        fit = [drone for drone in queue.ready if request.ever(drone)]
        if fit and all(wanted for _, wanted in queue.low.values()):
            drone = max(fit, key=lambda drone: drone.battery_level)
            level = request.level(drone, drone.location)
            queue.low[drone] = (queue.charged(drone, level), 0.0)
            queue.ready.remove(drone)
