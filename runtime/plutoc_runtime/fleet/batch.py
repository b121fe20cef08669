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
    from .queue import Queue

OLD = 1_800.0


class Batch:
    """Decorates a policy: of requests, in the order of their arrival, free drones and the queue.

    It returns a `Choice` or None for each. One `of` a hook may let trips wait as long as the hook wants.
    """

    def __init__(self, policy: Policy, of: object = None) -> None:
        self._policy, self._ages = policy, of is None
        self.asks = policy if of is None else of
        update_wrapper(self, policy)

    def __call__(self, *given: Any) -> Any:
        """Ask the policy."""
        return self._policy(*given)

    def share(self, queue: Queue, place: int) -> int:
        """Serve a request, and all around it of its policy and priority; return the place of the last."""
        waiting, one = queue.requests, queue.requests[place]
        if self._ages and queue.kernel.now - one.since >= OLD:
            queue.give(place, nearest(one.trip, queue.ready, one.able))
            fit = [] if one.is_set else [drone for drone in queue.ready if one.ever(drone)]
            if fit and all(wanted for _, wanted in queue.low.values()):
                drone = max(fit, key=lambda drone: drone.battery_level)
                queue.low[drone] = (
                    queue.charged(drone, one.level(drone, drone.location)),
                    0.0,
                )  # for no other
                queue.ready.remove(drone)
            return place

        def alike(place: int) -> bool:
            asks = getattr(waiting[place].policy, "asks", None)
            return asks is self.asks and waiting[place].rank[0] == one.rank[0]

        first = next((n + 1 for n in range(place - 1, -1, -1) if not alike(n)), 0)
        end = next((n for n in range(place + 1, len(waiting)) if not alike(n)), len(waiting))
        places = range(end - 1, first - 1, -1)
        choices = self._policy([waiting[each] for each in places], queue.ready, queue)
        for each, choice in zip(places, choices, strict=True):
            if queue.room:
                queue.give(each, choice)
        return first
