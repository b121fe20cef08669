"""An area of a missions file, `[[mission.area]]`, becomes trips that cover it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from math import dist
from typing import Any

from ..app import App
from ..extras import has
from ..shared.alone.files import with_fields
from ..shared.domain import values
from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.airspace import Airspace, Polygon
from ..shared.domain.fields import Entity
from ..shared.domain.model import Point, Trip
from ..shared.domain.quantities import Type
from ..shared.domain.text import number, quoted
from ..shared.domain.values import Keys, Table, read_parameters
from .reading import Document, MadeOfArea, PlanTable, no_such_name

SPACING = values.Quantity(Type.LENGTH, 0.05, 10_000.0)
"""The side of the square around each place."""

MOST_IN_ALL = 100_000
MOST_AREAS = 10_000
"""The most trips that the areas of one file make, and the most areas of one file."""


def trips_of_areas(
    mission: PlanTable, before: Sequence[Trip], app: App, airspace: Airspace
) -> list[Trip]:
    """Return the trips that the areas of a mission make, behind those before."""
    found = list[Any]()
    areas = dict[str, Table]()
    paths = {trip.name: (*mission.path, "trip", trip.index) for trip in before}
    needed: Keys = {"polygon": None, "action": partial(values.one_of, app.actions), "spacing": None}
    others: Keys = {"name": values.name, "height": None, "parameters": None}
    keys = with_fields(app, Entity.TRIP, needed, others)
    for place, table in enumerate(mission.tables("area"), 1):
        given = table.read(*keys)
        name = given.pop("name", None)
        table.differs("name", name, "area", areas)
        prefix = f"area {place}." if name is None else f"{name} "
        if given["action"] in (PICK, RELEASE):
            said = f"{given['action']} takes an item, and an area has none: write [[mission.trip]]"
            table.problem(said, "action")
        action = app.actions.get(given["action"])
        parameters = read_parameters(table.table("parameters"), action.parameters) if action else {}
        flown = [*before, *found]
        places = read_places(table, airspace, flown[-1].target if flown else None)
        made = [
            app.trip(
                **{**given, "parameters": {**parameters}},
                name=f"{prefix}{count}",
                target=target,
                index=len(flown) + count - 1,
            )
            for count, target in enumerate(places, 1)
        ]
        same = next((trip.name for trip in made if trip.name in paths), None)
        if same is not None:
            line = table.document.line((*paths[same], "name"))
            where = f", in line {line}" if line else ""
            said = f"makes a trip {quoted(same)}, and there is another{where}: rename that, or the area"
            table.problem(said)
        paths.update((trip.name, table.path) for trip in made)
        found += made
    return found


def read_places(table: PlanTable, airspace: Airspace, before: Point | None) -> Sequence[Point]:
    """Return the places of an area in the order in which they are flown to, and note what it has become.

    `before`: the last place of the mission before it.
    """
    document = table.document
    corners = table.value("polygon", partial(_corners, document))
    spacing = table.value("spacing", SPACING)
    height = table.value("height", values.HEIGHT)
    z = airspace.cruise_height if height is None else height
    if z > airspace.ceiling:
        said = f"height, {number(z)} m, is above the ceiling, {number(airspace.ceiling)} m"
        table.problem(said, "height")
    if not has("areas"):
        table.problem(_NO_SHAPELY)
        return ()
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
        said = f"makes more than {geometry.MOST:,} trips of this area: widen it"
        table.problem(f"spacing {number(spacing)} m {said}", "spacing")
        return ()
    if not found.places:
        said = "covers nothing that may be flown over: it lies in no-fly areas, or off the map"
        table.problem(f"polygon {said}", "polygon")
    document.swept += max(len(found.places), MOST_IN_ALL // MOST_AREAS)
    if document.swept > MOST_IN_ALL:
        said = f"makes more than {MOST_IN_ALL:,} trips, or has more than {MOST_AREAS:,} areas"
        table.problem(f"with this area the file {said}: widen the spacing", "spacing")
        return ()
    places = [(x, y, z) for x, y in found.places]
    metres = sum(_metres(airspace, a, b) for a, b in pairwise(places))
    made = MadeOfArea(who=table.who, trips=len(places), metres=metres, forbidden=found.forbidden)
    document.areas.append(made)
    document.is_made = True
    return places


def _metres(airspace: Airspace, start: Point, end: Point) -> float:
    """Return how long the way is from one place to the next; straight, if there is none."""
    route = airspace.route(start, end) or (end,)
    return sum(map(dist, (start, *route), route))


def _corners(document: Document, value: object) -> Polygon:
    """Read the corners of an area, or the name of a zone of the map that has some."""
    zones = document.landmarks.zone
    if not isinstance(value, str) or not zones:
        return values.each(values.corner, "corner", (), value)
    if value not in zones:
        raise ValueError(no_such_name("zone", value, zones))
    return zones[value]


_NO_SHAPELY = (
    "an area needs shapely, the extra `areas` of pluto-fleet:"
    ' pip install "pluto-fleet[areas]", or "shapely>=2"'
)
