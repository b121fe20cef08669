"""Which drone can fly which trip: by what it is, and by what is left in its battery."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot
from typing import TYPE_CHECKING

from .capability import stops_of, why_not
from .energy import CLIMB_SPEED, needed, share

if TYPE_CHECKING:
    from .airspace import Airspace
    from .app import App
    from .model import Category, Drone, Point, Trip

NO_WAY = 2.0
"""A battery level that no drone ever has."""


class Reach:
    """The battery levels with which a drone gets everywhere on the map and home again.

    Most drones that stand ready have more than that, and need no exact answer.
    """

    def __init__(self, app: App, airspace: Airspace) -> None:
        self.app, self.airspace = app, airspace
        self._levels: dict[tuple[Category, str], float] = {}

    def everywhere(self, category: Category, trip: Trip) -> float:
        """Return a level that is enough for this trip from anywhere on the map."""
        level = self._levels.get((category, trip.action))
        if level is None:
            level = self._level(category, trip.action)
            self._levels[category, trip.action] = level
        return level

    def _level(self, category: Category, action: str) -> float:
        space = self.airspace
        if space.no_fly or not category.can(action):
            return NO_WAY
        across = hypot(*space.size, space.ceiling)
        up_and_down = (space.cruise_height + space.ceiling) / CLIMB_SPEED
        # to the source, to the target, and home
        seconds = 3 * across / category.speed + up_and_down + self.app.actions[action].seconds
        return share(category, seconds) + category.reserve

    def on_map(self, trip: Trip) -> bool:
        """Say whether a trip leads nowhere but on the map; a hook may have changed it."""
        return all(
            self.airspace.problem(point) is None
            for point in (trip.source, trip.target)
            if point is not None
        )


class Demand:
    """What a chain of trips asks of a drone: the head trip, and with a pick all to its release."""

    __slots__ = ("_from", "_never", "_plain", "_reach", "_stops", "chain")

    def __init__(self, reach: Reach, chain: Sequence[Trip]) -> None:
        self.chain = chain
        self._reach = reach
        self._plain = len(chain) == 1 and chain[0].item is None and reach.on_map(chain[0])
        self._stops: Sequence[tuple[Point, float]] | None = None
        self._never: dict[tuple[Category, Point], str | None] | None = None
        self._from: dict[tuple[Category, Point, Point], float] | None = None

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the chain even with a full battery; None: it can."""
        if self._plain and self._reach.everywhere(drone.category, self.chain[0]) <= 1:
            return None
        if self._never is None:
            self._never = {}
        key = (drone.category, drone.home)
        if key not in self._never:
            reach = self._reach
            self._never[key] = why_not(reach.app, reach.airspace, *key, self.chain)
        return self._never[key]

    def battery(self, drone: Drone) -> float:
        """Return the battery level that it takes, the way home and the reserve included.

        More than 1 where no permitted way leads there.
        """
        if self._from is None:
            self._from = {}
        key = (drone.category, drone.home, drone.location)
        level = self._from.get(key)
        if level is None:
            reach = self._reach
            if self._stops is None:
                self._stops = stops_of(reach.app, reach.airspace, self.chain)
            part = needed(drone.category, reach.airspace, drone.location, self._stops, drone.home)
            level = NO_WAY if part is None else part + drone.category.reserve
            self._from[key] = level
        return level

    def met_by(self, drone: Drone) -> bool:
        """Say whether a drone can fly the chain now."""
        level = drone.battery_level
        if self._plain and level >= self._reach.everywhere(drone.category, self.chain[0]):
            return True
        return self.never(drone) is None and level >= self.battery(drone)
