"""`nearest`: the free drone that is closest to where the trip begins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .grid import Places

if TYPE_CHECKING:
    from ..model import Drone, Trip
    from ..policy import Able, Choice, Pool


def nearest() -> Pool:
    """Give each trip, in turn, the closest free drone."""
    return Nearest()


class Nearest:
    """The free drones, and where they stand."""

    def __init__(self) -> None:
        self._places: Places[Drone] = Places()
        self._away = 0.0
        """Of the drone chosen last."""
        self._say_why = self._why

    def add(self, drone: Drone) -> None:
        """A drone is free; it stays where it is while it is."""
        self._places.add(drone, drone.location)

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        self._places.remove(drone)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the closest drone that is able; of equals, the first of the fleet."""
        away, drone = self._places.closest(trip.source or trip.target, able)
        if drone is None:
            return None
        self._away = away
        return drone, self._say_why

    def _why(self) -> str:
        return f"nearest of {len(self._places)} free: {self._away:.1f} m away"
