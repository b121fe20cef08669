"""What a mission asks of the fleet when it wants a drone."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING

from .eligibility import Demand, Reach
from .signals import Signal

if TYPE_CHECKING:
    from .model import Drone, Trip
    from .policy import Pool


class Request(Signal["Drone"]):
    """A mission that waits for a drone; it is set to the one that it gets."""

    __slots__ = ("_demand", "_reach", "_trips", "levels", "pool", "trip", "why")

    def __init__(self, reach: Reach, trips: Sequence[Trip], pool: Pool) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.pool, self.trip = pool, trips[0]
        self.levels = reach.levels(self.trip)
        """What is surely enough for each category."""
        self.why = ""
        """Why it got its drone, if anybody wants to know."""
        self._reach, self._trips = reach, trips
        self._demand: Demand | None = None

    @property
    def waits(self) -> bool:
        """Whether it still wants a drone."""
        return not self.is_set

    @property
    def demand(self) -> Demand:
        """What it asks of a drone, exactly."""
        if self._demand is None:
            self._demand = Demand(self._reach, self._trips)
        return self._demand

    def able(self, drone: Drone) -> bool:
        """Say whether a drone can fly the trip now."""
        level = drone.telemetry.battery_level
        if level >= self.levels[drone.category]:
            return True
        return self.never(drone) is None and level >= self.demand.battery(drone)

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with a full battery; None: it can."""
        return None if self.levels[drone.category] <= 1.0 else self.demand.never(drone)

    def level(self, drone: Drone) -> float:
        """Return what it takes in a drone's battery, where it stands; never: infinite."""
        return inf if self.never(drone) is not None else self.demand.battery(drone)
