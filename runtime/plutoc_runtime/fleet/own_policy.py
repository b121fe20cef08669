"""A policy of the app's own: a hook that is asked trip by trip, or for all that wait at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import HookFault
from ..domain.model import Drone
from ..domain.text import class_of
from ..hooks.calls import ask_policy, hook_name
from .own_batch import chooses_for_all, own_batch

if TYPE_CHECKING:
    from ..domain.model import Trip
    from .policies import Able, Choice, OneByOne, Policy


def own_policy(hook: Callable[..., Any]) -> Policy:
    """Make a policy of the app's own hook, of either shape."""
    return own_batch(hook) if chooses_for_all(hook) else _trip_by_trip(hook)


def _trip_by_trip(hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> OneByOne:
    """Make a policy of a hook for one trip; it raises `HookFault` for what that may not answer."""
    name = hook_name(hook)

    def choose(trip: Trip, free: Sequence[Drone], able: Able) -> Choice | None:
        candidates = tuple(filter(able, free))
        if not candidates:
            return None
        drone = ask_policy(name, partial(hook, trip, candidates))
        if drone is None:
            return None
        if not any(drone is candidate for candidate in candidates):
            answer = f"drone {drone.id}" if type(drone) is Drone else class_of(drone)
            raise HookFault(
                f"policy {name} must return one of the candidates or None, not {answer}"
            )
        return drone, f"chosen by {name}"

    return choose
