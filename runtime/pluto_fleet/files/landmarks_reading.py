"""Reading the places, zones, north and floor plan of a fleet file's `[map]`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from ..shared.domain import values
from ..shared.domain.airspace import Airspace
from ..shared.domain.text import quoted
from . import errors
from .landmarks import Landmarks, NamedPlace, Picture, Zone
from .outline import outline

if TYPE_CHECKING:
    from .reading import Table

KEYS = ("image", "north", "places", "zones")
"""Their keys in `[map]`."""

MOST_PLACES, MOST_ZONES = 2_000, 500


def read_landmarks(table: Table, airspace: Airspace | None) -> Landmarks:
    """Return the landmarks of `[map]`, and report what is wrong; `airspace`: None if it is invalid."""
    whole = airspace and replace(airspace, no_fly=())  # a closed room may have a name, too
    names: dict[str, Table] = {}
    north = table.read("north", degrees) if "north" in table.data else None
    picture = _picture(table, (airspace or Airspace()).size)
    places = [_place(one, whole, names) for one in _tables(table, "place", MOST_PLACES)]
    zones = [_zone(one, whole, names) for one in _tables(table, "zone", MOST_ZONES)]
    return Landmarks(
        places=tuple(one for one in places if one is not None),
        zones=tuple(one for one in zones if one is not None),
        north=north or 0.0,
        picture=picture,
    )


def degrees(value: object) -> float:
    """Read an angle in degrees."""
    amount: float = values.real(value)
    if not -360.0 <= amount <= 360.0:
        raise ValueError("is no angle from -360 to 360 degrees")
    return amount


def _tables(table: Table, what: str, most: int) -> Sequence[Table]:
    key = f"{what}s"
    found = [*table.tables(key, f"map.{key}")]
    if len(found) > most:
        table.problem(errors.too_many(key, most), key)
    for number, one in enumerate(found, 1):
        one.who = f"{what} {number}"  # until its name is known
    return found[:most]


def _picture(table: Table, size: tuple[float, float]) -> Picture | None:
    if not isinstance(table.data.get("image"), dict):
        name = table.read("image", values.name)
        return None if name is None else Picture(file=name, size=size)
    given = table.table("image")
    assert given is not None  # it is a table
    given.who = f"{table.who}, image"
    given.only(("file", "at", "size", "turn"), "an image")
    file = given.read("file", values.name, required=True)
    at = given.read("at", values.corner) or (0.0, 0.0)
    of_this_size = given.read("size", values.size) or size
    turn = given.read("turn", degrees) or 0.0
    return None if file is None else Picture(file=file, at=at, size=of_this_size, turn=turn)


def _named(table: Table, what: str, names: dict[str, Table]) -> str | None:
    known = table.valid_name("name")
    if known is not None:
        table.who = f"{what} {quoted(known)}"
    name = table.read("name", values.name, required=True)
    if name is not None:
        table.differs("place or zone", "name", name, names)
    return name


def _place(table: Table, whole: Airspace | None, names: dict[str, Table]) -> NamedPlace | None:
    name = _named(table, "place", names)
    table.only(("name", "at"), "a place")
    at = table.read("at", values.point, required=True)
    if at is None:
        return None
    if whole is not None and (problem := whole.problem((*at, 0.0)[:3])):
        table.problem(f"at {problem}", "at")
    return None if name is None else NamedPlace(name=name, at=at)


def _zone(table: Table, whole: Airspace | None, names: dict[str, Table]) -> Zone | None:
    name = _named(table, "zone", names)
    table.only(("name", "corners"), "a zone")
    corners = table.read("corners", outline, required=True)
    for x, y in corners or ():
        if whole is not None and (problem := whole.problem((x, y, 0.0))):
            table.problem(f"corners: {problem}", "corners")
            break
    return None if name is None or corners is None else Zone(name=name, corners=corners)
