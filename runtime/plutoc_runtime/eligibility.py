"""Which drone can fly which trip: by what it is, and by what is left in its battery."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from typing import TYPE_CHECKING

from .capability import chain_of, stops_of, why_not
from .energy import CLIMB_SPEED, needed, share

if TYPE_CHECKING:
    from .airspace import Airspace
    from .app import App
    from .model import Category, Drone, Point, Trip

NO_WAY = 2.0
"""A battery level that no drone ever has."""

_REMEMBERED = 10_000
"""Targets kept: a hook may think of any number of them."""


class Reach:
    """What gets a drone anywhere on the map and home again: most that stand ready have more.

    So most questions need no exact answer, which takes a route.
    """

    def __init__(self, app: App, airspace: Airspace) -> None:
        self.app, self.airspace = app, airspace
        self._on_map: set[Point] = set()
        """Targets that have been looked at."""
        self._levels = {
            action: {category: self._level(category, action) for category in app.categories}
            for action in app.actions
        }
        self._unknown = dict.fromkeys(app.categories, NO_WAY)

    def levels(self, trip: Trip) -> Mapping[Category, float]:
        """Return a battery level for each category with which the trip can surely be flown.

        `NO_WAY` where that takes a closer look.
        """
        plain = trip.item is None and trip.source is None and trip.target in self._on_map
        return self._levels[trip.action] if plain or self._is_plain(trip) else self._unknown

    def _is_plain(self, trip: Trip) -> bool:
        """Say whether it carries nothing and stays on the map; a hook may have changed it."""
        places = (trip.target,) if trip.source is None else (trip.source, trip.target)
        if trip.item is not None or any(self.airspace.problem(place) for place in places):
            return False
        if len(self._on_map) == _REMEMBERED:
            self._on_map.clear()
        self._on_map.add(trip.target)
        return True

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
        self._reach, self._chain = reach, chain_of(trips)
        self._stops = stops_of(reach.app, reach.airspace, self._chain)
        self._never: dict[tuple[Category, Point], str | None] = {}
        self._from: dict[tuple[Category, Point, Point], float] = {}

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the chain even with a full battery; None: it can."""
        key = (drone.category, drone.home)
        if key not in self._never:
            reach = self._reach
            self._never[key] = why_not(reach.app, reach.airspace, *key, self._chain)
        return self._never[key]

    def battery(self, drone: Drone) -> float:
        """Return the battery level that it takes, the way home and the reserve included.

        More than 1 where no permitted way leads there.
        """
        key = (drone.category, drone.home, drone.location)
        level = self._from.get(key)
        if level is None:
            category, home, here = key
            part = needed(category, self._reach.airspace, here, self._stops, home)
            level = self._from[key] = NO_WAY if part is None else part + category.reserve
        return level
