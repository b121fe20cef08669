"""The map of a fleet file: `[map]`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.airspace import Airspace
from plutoc_runtime.domain.geometry import covers_ground
from plutoc_runtime.domain.quantities import Type

from . import errors, values
from .limits import HEIGHT, SIDE

if TYPE_CHECKING:
    from plutoc_runtime.domain.geometry import Corner

    from .table import Table

KEYS = ("size", "image", "cruise_height", "ceiling", "no_fly")


def read_map(top: Table) -> tuple[Airspace | None, str | None]:
    """Return the map and its picture; no map where it cannot be read."""
    table = top.table("map")
    if table is None:
        return (None if "map" in top.data else Airspace()), None
    table.only(KEYS, "[map]")
    image = table.read("image", values.name)
    plain = Airspace()
    size = table.read("size", _size) if "size" in table.data else plain.size
    cruise = _height(table, "cruise_height", plain.cruise_height)
    ceiling = _height(table, "ceiling", max(plain.ceiling, cruise or 0.0))
    no_fly = _no_fly(table)
    if cruise is not None and ceiling is not None and cruise > ceiling:
        table.problem(errors.cruise_above_ceiling(cruise, ceiling), "cruise_height")
    if size is None or cruise is None or ceiling is None or no_fly is None:
        return None, image
    airspace = Airspace(size=size, cruise_height=cruise, ceiling=ceiling, no_fly=no_fly)
    return airspace, image


def _height(table: Table, key: str, default: float) -> float | None:
    if key not in table.data:
        return default
    return table.read(key, partial(values.quantity, kind=Type.LENGTH, limit=HEIGHT))


def _size(value: object) -> Corner:
    width, depth = values.numbers(value, (2,), SIDE)
    return width, depth


def _no_fly(table: Table) -> tuple[tuple[Corner, ...], ...] | None:
    given = table.read("no_fly", _list)
    areas: list[tuple[Corner, ...]] = []
    bad = given is None and "no_fly" in table.data
    for index, element in enumerate(given or ()):
        try:
            areas.append(_area(element))
        except ValueError as error:
            table.problem(errors.no_fly_area(index + 1, str(error)), "no_fly", index)
            bad = True
    return None if bad else tuple(areas)


def _list(value: object) -> list[object]:
    if not isinstance(value, list):
        raise values.Wrong("is not a list of areas, each a list of corners [x, y]")
    return value


def _area(value: object) -> tuple[Corner, ...]:
    if not isinstance(value, list) or len(value) < 3:
        raise values.Wrong("is not a list of at least three corners [x, y]")
    corners: list[Corner] = []
    for place, element in enumerate(value, start=1):
        try:
            corners.append(values.corner(element))
        except ValueError as error:
            raise values.Wrong(f"has a corner {place} that {error}") from None
    if not covers_ground(corners):
        raise values.Wrong("covers no ground: its corners lie on one line")
    return tuple(corners)
