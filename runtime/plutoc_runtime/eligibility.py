"""Which drone can fly which trip: by what it is, and by what is left in its battery."""

from __future__ import annotations

from collections.abc import Sequence

from .airspace import Airspace
from .app import App
from .energy import needed
from .model import Drone, Trip
from .plan_check import stops_of, why_not


class Eligibility:
    """Answers for one app on one map. A chain is the head trip, and with a pick all to its release."""

    def __init__(self, app: App, airspace: Airspace) -> None:
        self._app, self._airspace = app, airspace

    def never(self, drone: Drone, chain: Sequence[Trip]) -> str | None:
        """Return why a drone cannot fly the chain even with a full battery; None: it can."""
        return why_not(self._app, self._airspace, drone.category, drone.home, chain)

    def battery(self, drone: Drone, chain: Sequence[Trip]) -> float:
        """Return the battery level that the chain takes, the way home and the reserve included.

        More than 1 where no permitted way leads there.
        """
        stops = stops_of(self._app, self._airspace, chain)
        share = needed(drone.category, self._airspace, drone.location, stops, drone.home)
        return 2.0 if share is None else share + drone.category.reserve
