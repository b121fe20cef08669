"""How one of several drones is chosen: the shape of every allocation policy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from .errors import HookFault
from .guard import by_a_person, guarded
from .hooks import hook_name, said, trace_of
from .model import Drone
from .words import class_of

if TYPE_CHECKING:
    from .model import Trip

Able = Callable[["Drone"], bool]
"""Says whether a drone may fly the trip now."""

Why = Callable[[], str]
"""Says why a drone was chosen, if it is asked at once: before the drone leaves the pool."""

Choice = tuple["Drone", Why]
"""The drone that gets a trip, and why it was chosen."""


class Pool(Protocol):
    """The free drones, from which a policy chooses."""

    def add(self, drone: Drone) -> None:
        """A drone is free; it stays where it is while it is."""
        ...

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        ...

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the drone that the policy wants for a trip; None: it has none for it."""
        ...


@runtime_checkable
class BatchPool(Pool, Protocol):
    """A pool whose policy looks at all trips that wait at once."""

    def share(self, offers: Sequence[tuple[Trip, Able]]) -> Sequence[Choice | None]:
        """Return a drone, or None, for each trip of one priority; no drone twice."""
        ...


Policy = Callable[[], Pool]
"""Makes the pool from which the drones are chosen."""


class FreeDrones:
    """What every pool of ours keeps: the free drones, in the order in which they came."""

    def __init__(self) -> None:
        self.free: dict[Drone, None] = {}

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        self.free[drone] = None

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        self.free.pop(drone, None)


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
