"""A policy of the app's own: a hook that is asked trip by trip."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..errors import HookFault
from ..guard import by_a_person, guarded
from ..hooks import hook_name, said, trace_of
from ..model import Drone
from ..policy import Able, Choice, FreeDrones, Policy, Pool
from ..words import class_of

if TYPE_CHECKING:
    from ..model import Trip


def own_policy(hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> Policy:
    """Make a policy of the app's own hook: it is asked trip by trip."""
    return OwnPolicy(hook)


@dataclass(frozen=True, slots=True)
class OwnPolicy:
    """A policy of the app's own. Two that ask the same hook are equal."""

    hook: Callable[[Any, Sequence[Drone]], Drone | None]

    def __call__(self) -> Pool:
        """Return an empty pool."""
        return Asked(self.hook)


class Asked(FreeDrones):
    """The free drones, in the fleet's order, for a hook to choose from."""

    def __init__(self, hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> None:
        super().__init__()
        self._hook, self._name = hook, hook_name(hook)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Ask the hook; raise `HookFault` for what it may not answer."""
        free = sorted(self.free, key=lambda drone: drone.index)
        candidates = tuple(drone for drone in free if able(drone))
        if not candidates:
            return None
        try:
            drone = guarded(partial(self._hook, trip, candidates))
        except BaseException as error:
            if by_a_person(error):
                raise
            raise HookFault(f"policy {self._name} raised {said(error)}", trace_of(error)) from error
        if drone is None:
            return None
        if not any(drone is candidate for candidate in candidates):
            raise HookFault(
                f"policy {self._name} must return one of the candidates or None, not {_named(drone)}"
            )
        return drone, lambda: f"chosen by {self._name}"


def _named(answer: object) -> str:
    """Name what a hook answered, in a word or two."""
    return f"drone {answer.id}" if type(answer) is Drone else class_of(answer)
