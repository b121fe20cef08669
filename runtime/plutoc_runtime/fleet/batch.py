"""Policies that choose for all waiting trips of one priority at once, and what keeps them from passing over one for ever.

A trip that has waited for `OLD` seconds goes before all younger ones of its priority: it gets the nearest drone that can fly it.
If all that are free are too low, as near trips keep them low, one is put aside until it is charged for it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import update_wrapper
from typing import TYPE_CHECKING

from .needs import Request
from .policies import nearest

if TYPE_CHECKING:
    from ..domain.model import Drone
    from .policies import Choice
    from .queue import Queue

AllAtOnce = Callable[[Sequence[Request], Sequence["Drone"], "Queue"], Sequence["Choice | None"]]
"""Chooses a different free drone, or None, for each request, in the order of their arrival."""

OLD = 1_800.0


class Batch:
    """Decorates such a policy, or makes one `of` a hook, which itself sees to it that none waits for ever."""

    def __init__(self, policy: AllAtOnce, of: object = None) -> None:
        self._policy, self._ages = policy, of is None
        self.asks = policy if of is None else of
        update_wrapper(self, policy)

    def __call__(
        self, requests: Sequence[Request], free: Sequence[Drone], queue: Queue
    ) -> Sequence[Choice | None]:
        """Return a drone, or None, for each request."""
        return self._policy(requests, free, queue)

    def share(self, queue: Queue, place: int) -> int:
        """Serve together the request at this place and all around it of the same policy and priority.

        Return the place of the first of them; of an old one its own.
        """
        waiting, oldest = queue.requests, queue.requests[place]
        if self._ages and queue.kernel.now - oldest.since >= OLD:
            queue.give(place, nearest(oldest.trip, queue.ready, oldest.able))
            if not oldest.is_set:
                self._keep_one(queue, oldest)
            return place

        def alike(place: int) -> bool:
            one = waiting[place]
            same = getattr(one.policy, "asks", None) is self.asks
            return same and one.rank[0] == oldest.rank[0]

        first = next((n + 1 for n in range(place - 1, -1, -1) if not alike(n)), 0)
        end = next((n for n in range(place + 1, len(waiting)) if not alike(n)), len(waiting))
        places = range(end - 1, first - 1, -1)
        offers = [waiting[each] for each in places]
        for each, choice in zip(places, self(offers, queue.ready, queue), strict=True):
            if queue.room:
                queue.give(each, choice)
        return first

    def _keep_one(self, queue: Queue, oldest: Request) -> None:
        """Put a drone aside until it is charged for a trip, unless one is."""
        fit = [drone for drone in queue.ready if oldest.ever(drone)]
        if fit and all(wanted for _, wanted in queue.low.values()):
            drone = max(fit, key=lambda one: one.battery_level)
            queue.low[drone] = queue.charged(drone, oldest.level(drone)), 0.0  # for no other trip
            queue.ready.remove(drone)
