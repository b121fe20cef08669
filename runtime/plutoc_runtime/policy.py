"""How one of several drones is chosen: the shape of every allocation policy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial, update_wrapper
from math import inf
from typing import TYPE_CHECKING, Any

from .errors import HookFault
from .guard import by_a_person, guarded
from .hooks import hook_name, said, trace_of
from .model import Drone
from .words import class_of

if TYPE_CHECKING:
    from .model import Trip

Able = Callable[["Drone"], bool]
"""Says whether a drone may fly the trip now. It can take a route: ask of as few as will do."""

Choice = tuple["Drone", str]
"""The drone that gets a trip, and why it was chosen."""

OneByOne = Callable[["Trip", Sequence["Drone"], Able], Choice | None]
"""Chooses one of the free drones, which come in the fleet's order, for a trip; None: none of them."""

AllAtOnce = Callable[[Sequence[tuple["Trip", Able]], Sequence["Drone"]], Sequence[Choice | None]]
"""Chooses a free drone, or None, for each of the trips that wait with one priority; none twice."""


class Batch:
    """A policy that looks at all trips at once: what decorates the function that does."""

    def __init__(self, policy: AllAtOnce) -> None:
        self._policy = policy
        update_wrapper(self, policy)

    def __call__(
        self, offers: Sequence[tuple[Trip, Able]], free: Sequence[Drone]
    ) -> Sequence[Choice | None]:
        """Return a drone, or None, for each trip."""
        return self._policy(offers, free)


Policy = OneByOne | Batch


def lowest(
    free: Sequence[Drone], able: Able, rank: Callable[[Drone], float]
) -> tuple[Drone, float] | None:
    """Return the able drone of the lowest rank, and that rank; of equals, the fleet's first."""
    found: Drone | None = None
    least = inf
    for drone in free:
        here = rank(drone)
        if here < least and able(drone):
            found, least = drone, here
    return None if found is None else (found, least)


def own_policy(hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> OneByOne:
    """Make a policy of the app's own hook; it raises `HookFault` for what that may not answer."""

    def choose(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
        candidates = tuple(filter(able, free))
        if not candidates:
            return None
        name = hook_name(hook)
        try:
            drone = guarded(partial(hook, trip, candidates))
        except BaseException as error:
            if by_a_person(error):
                raise
            raise HookFault(f"policy {name} raised {said(error)}", trace_of(error)) from error
        if drone is None:
            return None
        if not any(drone is candidate for candidate in candidates):
            answer = f"drone {drone.id}" if type(drone) is Drone else class_of(drone)
            raise HookFault(
                f"policy {name} must return one of the candidates or None, not {answer}"
            )
        return drone, f"chosen by {name}"

    return choose
