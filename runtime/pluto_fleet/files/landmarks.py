"""What a fleet file's map shows beside where drones may fly: named places, zones, north, a floor plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.airspace import Corner, Polygon


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedPlace:
    """A place with a name."""

    name: str
    at: tuple[float, ...]
    """x and y, and z where it was given, in metres."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone:
    """An area with a name."""

    name: str
    corners: Polygon


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A floor plan, and where it lies."""

    file: str
    """Relative to the fleet file."""
    at: Corner = (0.0, 0.0)
    """Its lower left corner, about which it is turned."""
    size: tuple[float, float]
    turn: float = 0.0
    """In degrees, clockwise."""


@dataclass(frozen=True, kw_only=True)
class Landmarks:
    """What the map shows; none of it changes how drones fly."""

    places: tuple[NamedPlace, ...] = ()
    zones: tuple[Zone, ...] = ()
    north: float = 0.0
    """Degrees by which north is turned from up, clockwise."""
    picture: Picture | None = None

    @cached_property
    def place(self) -> Mapping[str, tuple[float, ...]]:
        """Where each named place is."""
        return {one.name: one.at for one in self.places}

    @cached_property
    def zone(self) -> Mapping[str, Polygon]:
        """The corners of each zone."""
        return {one.name: one.corners for one in self.zones}


NO_LANDMARKS = Landmarks()
