"""What a fleet file's map shows beside where drones may fly: named places, zones, north, a floor plan."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from ..shared.domain import values
from ..shared.domain.airspace import Airspace
from .outline import outline

if TYPE_CHECKING:
    from ..shared.domain.airspace import Corner, Polygon
    from ..shared.domain.values import Keys, Table


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

KEYS = ("image", "north", "places", "zones")
"""Their keys in `[map]`."""

MOST_PLACES = 2_000
MOST_ZONES = 500


def read_landmarks(table: Table, airspace: Airspace | None) -> Landmarks:
    """Return the landmarks of `[map]`, and note what is wrong; `airspace`: None if it is invalid."""
    whole = airspace and replace(airspace, no_fly=())  # a closed room may have a name, too
    names: dict[str, Table] = {}
    at = partial(_at, whole)
    corners = partial(_corners, whole)
    places = _tables(table, "places", MOST_PLACES, {"name": values.name, "at": at}, names)
    zones = _tables(table, "zones", MOST_ZONES, {"name": values.name, "corners": corners}, names)
    return Landmarks(
        places=tuple(NamedPlace(**one) for one in places),
        zones=tuple(Zone(**one) for one in zones),
        north=table.value("north", degrees) or 0.0,
        picture=_picture(table, (airspace or Airspace()).size),
    )


def _tables(
    table: Table, key: str, most: int, keys: Keys, names: dict[str, Table]
) -> Iterator[dict[str, Any]]:
    """Yield what stands in the tables of a key that can be read."""
    tables = [*table.tables(key)]
    if len(tables) > most:
        table.problem(f"{key} are more than {most:,}", key)
    for one in tables[:most]:
        given = one.read(keys)
        one.differs("name", given["name"], "place or zone", names)
        if None not in given.values():
            yield given


def _at(whole: Airspace | None, value: object) -> tuple[float, ...]:
    values.point_on(whole, 0.0, values.point, value)
    found: tuple[float, ...] = values.point(value)
    return found


def _corners(whole: Airspace | None, value: object) -> Polygon:
    corners = outline(value)
    for x, y in corners:
        if whole is not None and (problem := whole.problem((x, y, 0.0))):
            raise ValueError(f"has a wrong corner: {problem}")
    return corners


def degrees(value: object) -> float:
    """Read an angle in degrees."""
    amount = values.real(value)
    if not -360.0 <= amount <= 360.0:
        raise ValueError("is no angle from -360 to 360 degrees")
    return amount


def _picture(table: Table, size: tuple[float, float]) -> Picture | None:
    if not isinstance(table.data.get("image"), dict):
        name = table.value("image", values.name)
        return None if name is None else Picture(file=name, size=size)
    others: Keys = {"at": values.corner, "size": values.size, "turn": degrees}
    given = table.table("image").read({"file": values.name}, others)
    return None if given["file"] is None else Picture(**{"size": size, **given})
