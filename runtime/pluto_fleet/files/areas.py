"""An area of a missions file, `[[mission.area]]`, becomes trips that cover it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import chain, count, pairwise
from math import dist
from typing import TYPE_CHECKING, Any

from ..app import App
from ..extras import has
from ..shared.alone.files import with_fields
from ..shared.domain import values
from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.airspace import Airspace, Polygon
from ..shared.domain.fields import Entity
from ..shared.domain.model import Point, Trip
from ..shared.domain.text import number, quoted
from ..shared.domain.values import Keys, Table, read_parameters
from .coverage import read_covered, read_on_the_way
from .lines import NEAREST, Line, lines, longest_line, stops
from .reading import Document, MadeOfArea, PlanTable, no_such_name

if TYPE_CHECKING:
    from .sweep import Covered, Sweep

MOST_IN_ALL = 100_000
MOST_AREAS = 10_000
"""The most trips that the areas of one file make, and the most areas of one file."""

OF_LANES = ("spacing", "overlap", "camera_view", "height", "on_the_way", "side_by_side")
"""Keys that say how an area is flown over."""


def trips_of_areas(
    mission: PlanTable, before: Sequence[Trip], app: App, airspace: Airspace
) -> list[list[Trip]]:
    """Return the trips that the areas of a mission make, behind those before; a list for each lane."""
    found = list[list[Any]]()
    areas = dict[str, Table]()
    paths = {trip.name: (*mission.path, "trip", trip.index) for trip in before}
    needed: Keys = {"polygon": None, "action": partial(values.one_of, app.actions)}
    others: Keys = {"name": values.name, "parameters": None, **dict.fromkeys(OF_LANES)}
    keys = with_fields(app, Entity.TRIP, needed, others)
    tables = [*mission.tables("area")]
    for place, table in enumerate(tables, 1):
        given = table.read(*keys)
        name = given.pop("name", None)
        table.differs("name", name, "area", areas)
        prefix = f"area {place}." if name is None else f"{name} "
        if given["action"] in (PICK, RELEASE):
            said = f"{given['action']} takes an item, and an area has none: write [[mission.trip]]"
            table.problem(said, "action")
        is_alone = not before and len(tables) == 1
        if table.value("side_by_side", values.boolean) and not is_alone:
            said = "is flown side by side, a mission for each lane: its own may have nothing else"
            table.problem(said, "side_by_side")
        action = app.actions.get(given["action"])
        given["parameters"] = (
            read_parameters(table.table("parameters"), action.parameters) if action else {}
        )
        flown = [*before, *chain.from_iterable(found)]
        lanes = read_lanes(table, app, airspace, flown[-1].target if flown else None)
        numbers = count(1)
        indexes = count(len(flown))
        made = [
            [_trip(app, given, line, f"{prefix}{next(numbers)}", next(indexes)) for line in lane]
            for lane in lanes
        ]
        names = [trip.name for lane in made for trip in lane]
        same = next((one for one in names if one in paths), None)
        if same is not None:
            line = table.document.line((*paths[same], "name"))
            where = f", in line {line}" if line else ""
            said = f"makes a trip {quoted(same)}, and there is another{where}: rename that, or the area"
            table.problem(said)
        paths.update(dict.fromkeys(names, table.path))
        found += made
    return found


def _trip(app: App, given: Mapping[str, Any], line: Line, name: str, index: int) -> Any:
    """Return the trip of a line, or of a stop."""
    parameters = {**given["parameters"]}
    facts = {**given, "parameters": parameters, "name": name, "index": index, "target": line.end}
    if line.places > 1:
        every = round(line.every, 3)
        along = {"action": given["action"], "parameters": {**parameters}, "metres": every}
        facts |= {"source": line.start, "along": along}
    return app.trip(**facts)


def is_side_by_side(mission: PlanTable) -> bool:
    """Return whether each lane of a mission's area is to be a mission of its own."""
    areas = mission.data["area"]
    tables = [one for one in areas if isinstance(one, dict)] if isinstance(areas, list) else []
    return any(one.get("side_by_side") is True for one in tables)


def read_lanes(
    table: PlanTable, app: App, airspace: Airspace, before: Point | None
) -> Sequence[Sequence[Line]]:
    """Return the lanes of an area in the order in which they are flown, and note what it has become.

    Each is a list of stops, or of lines on which its action is done on the way. `before`: the last place of the
    mission before it.
    """
    document = table.document
    corners = table.value("polygon", partial(_corners, document))
    height = table.value("height", values.HEIGHT)
    z = airspace.cruise_height if height is None else height
    covered = read_covered(table, z)
    on_the_way = read_on_the_way(table, app)
    if z > airspace.ceiling:
        said = f"height, {number(z)} m, is above the ceiling, {number(airspace.ceiling)} m"
        table.problem(said, "height")
    if not has("areas"):
        table.problem(_NO_SHAPELY)
        return ()
    if corners is None or document.swept > MOST_IN_ALL:  # of what is too much, one has told
        return ()
    found = _swept(table, corners, covered, airspace, before, on_the_way)
    if found is None:
        return ()
    places = [[(x, y, z) for x, y in lane] for lane in found.lanes]
    if on_the_way:
        longest = longest_line(app.categories, table.data["action"])
        flown = [lines(lane, airspace, longest) for lane in places]
    else:
        flown = [stops(lane) for lane in places]
    each = [line for lane in flown for line in lane]
    way = [point for line in each for point in (line.start, line.end)]
    flown_way = [*way[:1], *chain.from_iterable(_route(airspace, a, b) for a, b in pairwise(way))]
    made = MadeOfArea(
        who=table.who,
        trips=len(each),
        places=len(found.places),
        metres=sum(dist(a, b) for a, b in pairwise(flown_way)),
        outside=found.outside([(x, y) for x, y, _ in flown_way]),
        forbidden=found.forbidden,
    )
    document.areas.append(made)
    document.is_made = True
    return flown


def _swept(
    table: PlanTable,
    corners: Polygon,
    covered: Covered | None,
    airspace: Airspace,
    before: Point | None,
    on_the_way: bool,
) -> Sweep | None:
    """Return how an area is swept; None: it cannot be, and that is noted."""
    from . import sweep as geometry  # shapely takes long to import

    document = table.document
    wrong = geometry.problem_of(corners)
    if wrong is not None:
        table.problem(f"polygon {wrong}", "polygon")
    if wrong is not None or covered is None:
        return None
    key = "spacing" if "spacing" in table.data else "overlap"
    mend = "widen" if key == "spacing" else "lessen"
    called = f"{key} {values.shown(table.data[key])}"
    if on_the_way and min(*covered(True), *covered(False)) < NEAREST:
        said = f"leaves too little between two places: on the way {number(NEAREST)} m are the least"
        table.problem(f"{called} {said}", key)
        return None
    try:
        found = geometry.sweep(
            corners, covered, airspace, before and before[:2], over_edges=on_the_way
        )
    except geometry.TooManyPlaces:
        document.swept += geometry.MOST
        said = f"makes more than {geometry.MOST:,} trips of this area: {mend} it"
        table.problem(f"{called} {said}", key)
        return None
    if not found.places:
        said = "covers nothing that may be flown over: it lies in no-fly areas, or off the map"
        table.problem(f"polygon {said}", "polygon")
    document.swept += max(len(found.places), MOST_IN_ALL // MOST_AREAS)
    if document.swept > MOST_IN_ALL:
        said = f"makes more than {MOST_IN_ALL:,} trips, or has more than {MOST_AREAS:,} areas"
        table.problem(f"with this area the file {said}: {mend} the {key}", key)
        return None
    return found


def _route(airspace: Airspace, start: Point, end: Point) -> Sequence[Point]:
    """Return the way from one place to the next, without the first; straight, if there is none."""
    return airspace.route(start, end) or (end,)


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
