"""What a mission asks of the fleet when it wants a drone: of its category and of its battery."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot, inf
from typing import TYPE_CHECKING

from ..time.future import Future
from .capability import chain_of, stops_of, why_not
from .energy import CLIMB_SPEED, needed, share

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.model import Category, Drone, Point, Trip
    from .policy import Policy

NO_WAY = 2.0
"""A battery level that no drone ever has."""


class Reach:
    """What gets a drone anywhere on the map and home again: most that stand ready have more.

    So most questions need no exact answer, which takes a route.
    """

    def __init__(self, app: App, airspace: Airspace) -> None:
        self.app, self.airspace = app, airspace
        self._levels = {
            action: {category: self._level(category, action) for category in app.categories}
            for action in app.actions
        }
        self._unknown = dict.fromkeys(app.categories, NO_WAY)

    def levels(self, trip: Trip) -> Mapping[Category, float]:
        """Return a battery level for each category with which the trip can surely be flown.

        `NO_WAY` where that takes a closer look: at an item, or at a place that is not on the map.
        """
        problem, start = self.airspace.problem, trip.source or trip.target
        if trip.item is not None or problem(start) or problem(trip.target):
            return self._unknown
        return self._levels[trip.action]

    def _level(self, category: Category, action: str) -> float:
        space = self.airspace
        if space.no_fly or not category.can(action):
            return NO_WAY
        across = hypot(*space.size, space.ceiling)
        up_and_down = (space.cruise_height + space.ceiling) / CLIMB_SPEED
        # to the source, to the target, and home
        seconds = 3 * across / category.speed + up_and_down + self.app.actions[action].seconds
        return share(category, seconds) + category.reserve


class Demand:
    """What the next trip asks of a drone: that one alone, or from a pick all to its release."""

    def __init__(self, reach: Reach, trips: Sequence[Trip]) -> None:
        self._app, self._airspace, self._chain = reach.app, reach.airspace, chain_of(trips)
        self._stops = stops_of(reach.app, reach.airspace, self._chain)
        self._never: dict[tuple[Category, Point], str | None] = {}
        self._levels: dict[tuple[Category, Point, Point], float] = {}

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the chain even with a full battery; None: it can."""
        key = (drone.category, drone.home)
        if key not in self._never:
            self._never[key] = why_not(self._app, self._airspace, *key, self._chain)
        return self._never[key]

    def battery(self, drone: Drone) -> float:
        """Return the battery level that it takes, the way home and the reserve included."""
        key = category, home, here = drone.category, drone.home, drone.location
        if key not in self._levels:
            part = needed(category, self._airspace, here, self._stops, home)
            self._levels[key] = NO_WAY if part is None else part + category.reserve
        return self._levels[key]


class Request(Future["Drone"]):
    """A mission that waits for a drone; it is set to the one that it gets."""

    __slots__ = ("_demand", "_levels", "_reach", "_trips", "policy", "trip", "why")

    def __init__(self, reach: Reach, trips: Sequence[Trip], policy: Policy) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self.trip, self.policy = trips[0], policy
        self.why = ""
        """Why it got its drone."""
        self._levels = reach.levels(self.trip)
        self._reach, self._trips = reach, trips
        self._demand: Demand | None = None

    @property
    def demand(self) -> Demand:
        """What it asks of a drone, exactly."""
        if self._demand is None:
            self._demand = Demand(self._reach, self._trips)
        return self._demand

    def able(self, drone: Drone) -> bool:
        """Say whether a drone can fly the trip now."""
        level = drone.telemetry.battery_level
        return level >= self._levels[drone.category] or level >= self.level(drone)

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the trip even with a full battery; None: it can."""
        return None if self._levels[drone.category] <= 1.0 else self.demand.never(drone)

    def level(self, drone: Drone) -> float:
        """Return what it takes in a drone's battery, where it stands; never: infinite."""
        return inf if self.never(drone) is not None else self.demand.battery(drone)
