"""What a fleet file says: the map, the drones on it, and what a simulation makes them see."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .model import AfterTrip

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .airspace import Airspace
    from .model import Point
    from .world import WorldData


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneData:
    """A drone as the fleet file has it."""

    id: str
    category: str
    """The name of one of the app's categories."""
    home: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetData:
    """What the brain must know of a fleet."""

    airspace: Airspace
    drones: Sequence[DroneData]
    after_trip: AfterTrip = AfterTrip.HOME
    max_airborne: int | None = None
    world: WorldData | None = None
    """None: a simulation makes up a world from its seed."""
