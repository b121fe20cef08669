"""What another program has drawn, put into the map of a fleet file: its places, its areas as zones, and where not to fly."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import ceil
from typing import Any

from ..extras import has
from ..geodesy import Degrees, LocalPlane
from ..shared.alone.files import read_map
from ..shared.domain import values
from ..shared.domain.airspace import Airspace, Corner, Polygon
from ..shared.domain.text import counted, number
from .drawings.feature import Drawing, Feature, Kind, Unusable
from .drawings.on_map import metres_of
from .drawn_missions import no_origin
from .landmarks import MOST_CORNERS, Landmarks, NamedPlace, Zone, read_landmarks
from .reading import PlanTable, parsed
from .toml import toml_value
from .writing import with_landmarks

MARGIN = 20.0
"""Metres around what is drawn, on a map that is made for it."""
CRUISE = 20.0
_CEILING = 120.0
"""How high drones fly on such a map, and at most, in metres: in many countries nothing may fly higher."""
_TOLERANCES = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
"""By how many metres an edge may move, so that it has fewer corners."""
_ROUND = 10.0
"""To how many metres the sides of such a map are rounded up."""


@dataclass(slots=True)
class Taken:
    """What of a drawing has become part of a map."""

    places: list[NamedPlace] = field(default_factory=list)
    zones: list[Zone] = field(default_factory=list)
    no_fly: list[Polygon] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def sentence(self) -> str:
        """What it is, for people."""
        parts = (
            (self.places, "place"),
            (self.zones, "zone"),
            (self.no_fly, "no-fly area"),
        )
        return ", ".join(counted(len(these), what) for these, what in parts if these) or "nothing"


_TOO_WIDE = (
    "is drawn over more than 10 km, and a map has no longer sides: leave out what lies elsewhere"
)


def map_for(drawing: Drawing) -> str:
    """Return the text of a fleet file whose map is as large as a drawing; raise `Unusable` if that is no map."""
    spots = [spot for feature in drawing.features for spot in feature.spots]
    if not spots:
        raise Unusable(f"is {drawing.what}, and has no places and no areas")
    origin, size = plane_around([(one.latitude, one.longitude, 0.0) for one in spots])
    at = {"latitude": origin.latitude, "longitude": origin.longitude, "altitude": 0.0}
    keys = {"size": size, "origin": at, "cruise_height": CRUISE, "ceiling": _CEILING}
    return "\n".join(["[map]", *(f"{key} = {toml_value(one)}" for key, one in keys.items()), ""])


def plane_around(places: Sequence[Degrees]) -> tuple[LocalPlane, list[float]]:
    """Return the plane at the south-western corner of a map around places, and the sides of that map, in metres.

    Raises `Unusable` if they are too far from each other.
    """
    south = min(latitude for latitude, _, _ in places)
    west = min(longitude for _, longitude, _ in places)
    latitude, longitude, _ = LocalPlane(south, west).to_degrees((-MARGIN, -MARGIN, 0.0))
    origin = LocalPlane(round(latitude, 6), round(longitude, 6))
    try:
        far = [origin.to_metres((latitude, longitude, 0.0)) for latitude, longitude, _ in places]
    except ValueError:
        raise Unusable(_TOO_WIDE) from None
    size = [_ROUND * ceil((max(at[axis] for at in far) + MARGIN) / _ROUND) for axis in (0, 1)]
    if max(size) > values.SIDE.most:
        raise Unusable(_TOO_WIDE)
    return origin, size


def with_drawing(name: str, text: str, drawing: Drawing, *, closed: bool) -> tuple[str, Taken]:
    """Return the text of a fleet file with what is drawn in its map, and what that is.

    A place or a zone whose name is there already takes its place. `closed`: all areas are no-fly areas. Raises
    `BadInput` if the file cannot have it, and `Unusable` if the drawing cannot be on the map.
    """
    airspace, landmarks = map_in(name, text)
    with_more, taken = landmarks_with(landmarks, drawing, closed=closed)
    changed = with_landmarks(text, landmarks, with_more, airspace.size)
    if new := [area for area in taken.no_fly if area not in airspace.no_fly]:
        closed_areas = [[[*corner] for corner in area] for area in (*airspace.no_fly, *new)]
        changed = _with_no_fly(changed, closed_areas)
    map_in(f"{name}, with what is drawn", changed)
    return changed, taken


def landmarks_with(
    landmarks: Landmarks, drawing: Drawing, *, closed: bool = False
) -> tuple[Landmarks, Taken]:
    """Return landmarks with the places and zones of a drawing, and all that is taken of it.

    Raises `Unusable` if it cannot be on the map.
    """
    if landmarks.plane is None:
        raise Unusable(no_origin(drawing))
    taken = _taken(drawing, landmarks.plane, closed=closed)
    places = _merged(landmarks.places, taken.places)
    zones = _merged(landmarks.zones, taken.zones)
    return replace(landmarks, places=places, zones=zones), taken


def map_in(name: str, text: str) -> tuple[Airspace, Landmarks]:
    document = parsed(name, text)
    table = PlanTable(document, document.data).table("map")
    airspace = read_map(table)
    landmarks = read_landmarks(table, airspace)
    document.refuse_if_bad()
    assert airspace is not None  # else there was a problem
    return airspace, landmarks


def _with_no_fly(text: str, areas: Sequence[object]) -> str:
    import tomlkit  # only to write

    document: Any = tomlkit.parse(text)
    document["map"]["no_fly"] = tomlkit.value(toml_value([*areas]))
    return tomlkit.dumps(document)


def _taken(drawing: Drawing, plane: LocalPlane, *, closed: bool) -> Taken:
    taken = Taken(notes=[*drawing.notes])
    for place, feature in enumerate(drawing.features, 1):
        name = feature.name or f"{feature.kind.value} {place}".capitalize()
        match feature.kind:
            case Kind.PLACE:
                at = metres_of(plane, feature.spots[0], feature.who)
                taken.places.append(NamedPlace(name=name, at=tuple(at)))
            case Kind.ROUTE:
                taken.notes.append(
                    f"{feature.who} is left out: it is no part of a map, but makes a mission"
                )
            case _:
                if feature.has_holes:
                    taken.notes.append(f"{feature.who} has holes, which are left out")
                forbidden = closed or feature.kind is Kind.NO_FLY
                outline, note = fewer_corners(tuple(_outline(plane, feature)), around=forbidden)
                if note:
                    taken.notes.append(f"{feature.who} {note}")
                if forbidden:
                    taken.no_fly.append(outline)
                else:
                    taken.zones.append(Zone(name=name, corners=outline))
    return taken


def _outline(plane: LocalPlane, feature: Feature) -> Iterator[Corner]:
    for spot in feature.spots:
        x, y, *_ = metres_of(plane, spot, feature.who)
        yield round(x, 3) + 0.0, round(y, 3) + 0.0


def fewer_corners(outline: Polygon, *, around: bool) -> tuple[Polygon, str]:
    """Return an outline with no more corners than a map takes, and what was done for that, as a note continues.

    `around`: what it becomes lies around all of it. A boundary that was walked with a receiver has thousands.
    """
    if len(outline) <= MOST_CORNERS or not has("areas"):
        return outline, ""  # without shapely it is told that they are too many
    from shapely import Polygon as Shape  # slow to import

    whole = Shape(outline)
    for tolerance in _TOLERANCES if whole.is_valid else ():
        shape = (whole.buffer(1.5 * tolerance) if around else whole).simplify(tolerance)
        corners = tuple((round(x, 3), round(y, 3)) for x, y in shape.exterior.coords[:-1])
        if len(corners) > MOST_CORNERS or (around and not Shape(corners).contains(whole)):
            continue
        off = number(round(whole.hausdorff_distance(shape), 2))
        became = f"has {len(outline):,} corners, and becomes {len(corners)}"
        return corners, f"{became}: its edge moves by up to {off} m"
    return outline, ""


def _merged(known: Iterable[Any], new: Sequence[Any]) -> tuple[Any, ...]:
    """Return landmarks with new ones, each in the place of one that is called so."""
    by_name = {one.name: one for one in (*known, *new)}
    return tuple(by_name.values())
