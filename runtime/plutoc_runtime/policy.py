"""How one of several drones is chosen: the shape of every allocation policy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    from .model import Drone, Trip

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
