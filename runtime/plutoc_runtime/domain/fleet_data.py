"""A fleet as its file describes it: the map, the drones, and the world that is simulated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import exp, inf
from typing import Any

from .airspace import Airspace, Corner
from .model import AfterTrip, Point
from .motion import STRAIGHT, Motion


@dataclass(frozen=True, slots=True, kw_only=True)
class Feature:
    """An object on the ground that a photo can show."""

    kind: str
    at: Corner
    radius: float = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where a quantity is highest, by how much, and how far it spreads."""

    quantity: str
    at: Corner
    peak: float
    radius: float  # metres within which most of it stays: the standard deviation of a bell curve

    def at_distance(self, x: float, y: float) -> float:
        """Return its contribution at a distance in metres."""
        away, spread = x * x + y * y, 2 * self.radius * self.radius
        if away == 0.0 or spread == inf:
            return self.peak
        return self.peak * exp(-away / spread) if spread > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldData:
    """A world as a fleet file describes it."""

    features: tuple[Feature, ...] = ()
    sources: tuple[Source, ...] = ()
    background: Mapping[str, float] = field(default_factory=dict)
    """Beside `BACKGROUND`, or instead of its numbers."""
    movers: tuple[Any, ...] = ()
    """What moves there, in an app that can tell."""
    events: tuple[Mapping[str, Any], ...] = ()
    """What happens there, in an app with events."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneData:
    """A drone as the fleet file describes it."""

    id: str
    category: str  # the name of one of the app's categories
    home: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetData:
    """What the brain needs to know about a fleet."""

    airspace: Airspace
    drones: Sequence[DroneData]
    after_trip: AfterTrip = AfterTrip.NEXT
    max_airborne: int | None = None
    charges_at_home: bool = True  # of simulated drones: a real one says what it has
    motion: Motion = STRAIGHT
    began: float = 0.0
    """When a simulation begins, in seconds since 1970."""
    zone: str = "UTC"
    """The zone whose hours count then, as "Europe/Rome"; empty: that of this computer."""
    world: WorldData | None = None  # None: a simulation makes up a world from its seed
