"""An area of a missions file, `[[mission.area]]`, becomes trips that cover it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING

from ..extras import has
from ..shared.domain import values
from ..shared.domain.quantities import Type
from ..shared.domain.text import quoted
from . import errors
from .reading import MadeOfArea

if TYPE_CHECKING:
    from ..shared.domain.airspace import Airspace, Corner, Polygon
    from ..shared.domain.model import Point
    from .reading import Document, Table

BASIC = ("name", "polygon", "action", "spacing", "height", "parameters")
"""The keys of an area, beside a trip's fields."""

SPACING = values.Quantity(Type.LENGTH, 0.05, 10_000.0)
"""The side of the square around each place."""

MOST_IN_ALL = 100_000
MOST_AREAS = 10_000
"""The most trips that the areas of one file make, and the most areas of one file."""


def named(table: Table, number: int, names: dict[str, Table]) -> str:
    """Return what an area's trips are called, before their numbers."""
    mission, known = table.who, table.valid_name("name")
    table.who = f"{mission}, area {number if known is None else quoted(known)}"
    name = table.read("name", values.name)
    if name is None:
        return f"area {number}."
    table.differs("area", "name", name, names)
    return f"{name} "


def read_places(table: Table, airspace: Airspace, before: Point | None) -> Sequence[Point]:
    """Return the places of an area in the order in which they are flown to, and note what it has become.

    `before`: the last place of the mission before it.
    """
    corners = table.read("polygon", partial(_corners, table.document), required=True)
    spacing = table.read("spacing", SPACING, required=True)
    height = table.read("height", values.HEIGHT)
    z = airspace.cruise_height if height is None else height
    if z > airspace.ceiling:
        table.problem(errors.area_too_high(z, airspace.ceiling), "height")
    if not has("areas"):
        table.problem(errors.no_shapely())
        return ()
    document = table.document
    if corners is None or document.swept > MOST_IN_ALL:  # of what is too much, one has told
        return ()
    from . import sweep as geometry  # shapely takes long to import

    wrong = geometry.problem_of(corners)
    if wrong is not None:
        table.problem(f"polygon {wrong}", "polygon")
    if wrong is not None or spacing is None:
        return ()
    try:
        found = geometry.sweep(corners, spacing, airspace, before and before[:2])
    except geometry.TooManyPlaces:
        document.swept += geometry.MOST
        table.problem(errors.too_many_places(spacing, geometry.MOST), "spacing")
        return ()
    if not found.places:
        table.problem(errors.nothing_permitted(), "polygon")
    document.swept += max(len(found.places), MOST_IN_ALL // MOST_AREAS)
    if document.swept > MOST_IN_ALL:
        table.problem(errors.too_many_in_all(MOST_IN_ALL, MOST_AREAS), "spacing")
        return ()
    places = [(x, y, z) for x, y in found.places]
    document.is_made = True
    document.areas.append(
        MadeOfArea(
            who=table.who,
            trips=len(places),
            metres=sum(_metres(airspace, a, b) for a, b in pairwise(places)),
            forbidden=found.forbidden,
        )
    )
    return places


def _metres(airspace: Airspace, start: Point, end: Point) -> float:
    """Return how long the way is from one place to the next; straight, if there is none."""
    route = airspace.route(start, end) or (end,)
    return sum(map(dist, (start, *route), route))


def _corners(document: Document, value: object) -> Polygon:
    """Read the corners of an area, or the name of a zone of the map that has some."""
    zones = {} if document.landmarks is None else document.landmarks.zone
    if isinstance(value, str) and zones:
        if value not in zones:
            raise ValueError(errors.no_such_name("zone", value, zones))
        return zones[value]
    if not isinstance(value, list) or len(value) < 3:
        raise ValueError("is not a list of at least three corners [x, y]")
    corners: list[Corner] = []
    for place, element in enumerate(value, 1):
        try:
            corners.append(values.corner(element))
        except ValueError as error:
            raise ValueError(f"has a corner {place} that {error}") from None
    return tuple(corners)
