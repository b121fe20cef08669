"""Which drone can fly which trip: by what it is, and by what is left in its battery."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .capability import stops_of, why_not
from .energy import needed

if TYPE_CHECKING:
    from .airspace import Airspace
    from .app import App
    from .model import Category, Drone, Point, Trip

NO_WAY = 2.0
"""A battery level that no drone ever has."""


class Demand:
    """What a chain of trips asks of a drone: the head trip, and with a pick all to its release."""

    def __init__(self, app: App, airspace: Airspace, chain: Sequence[Trip]) -> None:
        self.chain = chain
        self._app, self._airspace = app, airspace
        self._stops = stops_of(app, airspace, chain)
        self._never: dict[tuple[Category, Point], str | None] = {}
        self._from: dict[tuple[Category, Point, Point], float] = {}

    def never(self, drone: Drone) -> str | None:
        """Return why a drone cannot fly the chain even with a full battery; None: it can."""
        key = (drone.category, drone.home)
        if key not in self._never:
            self._never[key] = why_not(self._app, self._airspace, *key, self.chain)
        return self._never[key]

    def battery(self, drone: Drone) -> float:
        """Return the battery level that it takes, the way home and the reserve included.

        More than 1 where no permitted way leads there.
        """
        key = (drone.category, drone.home, drone.location)
        level = self._from.get(key)
        if level is None:
            share = needed(drone.category, self._airspace, drone.location, self._stops, drone.home)
            level = NO_WAY if share is None else share + drone.category.reserve
            self._from[key] = level
        return level

    def met_by(self, drone: Drone) -> bool:
        """Say whether a drone can fly the chain now."""
        return self.never(drone) is None and drone.battery_level >= self.battery(drone)
