"""What a fleet file's map shows beside where drones may fly: named places, zones, north, a floor plan; and where it lies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

from ..geodesy import LocalPlane
from ..shared.domain import values
from ..shared.domain.airspace import EPSILON, Airspace, Corner, Polygon, distance, tidy
from ..shared.domain.text import place
from ..shared.domain.values import Keys, Table
from .origin import north_by, read_plane


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
    """What the map shows, and where it lies on the Earth; none of it changes ways in metres."""

    places: tuple[NamedPlace, ...] = ()
    zones: tuple[Zone, ...] = ()
    north: float = 0.0
    """Degrees by which north is turned from up, clockwise."""
    picture: Picture | None = None
    plane: LocalPlane | None = None
    """None: that is not said, as indoors."""

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
        north=north_by(table, table.value("north", degrees)),
        picture=_picture(table, (airspace or Airspace()).size),
        plane=read_plane(table),
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


MOST_CORNERS = 200


def outline(value: object) -> Polygon:
    """Read the corners of a polygon that does not cross itself."""
    corners = tidy(values.polygon(value))
    if len(corners) > MOST_CORNERS:
        raise ValueError(f"has more than {MOST_CORNERS} corners")
    if (spot := crossing(corners)) is not None:
        where = place((*spot, 0.0))
        raise ValueError(
            f"crosses or touches itself near {where}: name the corners in their order around it"
        )
    return corners


def crossing(corners: Sequence[Corner]) -> Corner | None:
    """Return a corner beside which an outline crosses or touches itself, or None."""
    edges = [*pairwise([*corners, *corners[:1]])]
    for i, (a, b) in enumerate(edges):
        if _turns_back(a, b, edges[(i + 1) % len(edges)][1]):
            return b
        last = len(edges) - (i == 0)  # the edges beside this one share a corner with it
        if any(_meet(a, b, c, d) for c, d in edges[i + 2 : last]):
            return a
    return None


def _turns_back(a: Corner, b: Corner, c: Corner) -> bool:
    """Return whether the edge from b to c lies on the one from a to b."""
    return min(distance(c, a, b), distance(a, b, c)) <= EPSILON


def _meet(a: Corner, b: Corner, c: Corner, d: Corner) -> bool:
    """Return whether two edges cross or touch."""
    if min(distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)) <= EPSILON:
        return True
    return _side(a, b, c) != _side(a, b, d) and _side(c, d, a) != _side(c, d, b)


def _side(a: Corner, b: Corner, c: Corner) -> bool:
    """Return whether c is to the left of the line from a to b."""
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
