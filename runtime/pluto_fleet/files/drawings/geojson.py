"""GeoJSON (RFC 7946): features of GIS programs, of web maps, of farm programs; and ours."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...process.untrusted import parsed
from ...shared.domain.text import counted, quoted
from .feature import (
    CUT_OFF,
    GEOJSON,
    Drawing,
    Feature,
    Kind,
    Spot,
    Unusable,
    called,
    corners,
    is_no_fly,
    name_in,
    refuse_if_many,
    spot,
)

_WGS_84 = ("CRS84", "4326", "WGS84", "WGS 84")
_NAMES = ("name", "Name", "NAME", "title", "label", "id")
"""Properties that may hold a feature's name; the first that is there counts."""
_PARTS = {"MultiPoint": "Point", "MultiLineString": "LineString", "MultiPolygon": "Polygon"}


def read(text: str) -> Drawing:
    """Return what is drawn; raise `Unusable` with what is wrong."""
    try:
        data = parsed(text)
    except ValueError as error:
        raise Unusable(f"cannot be read as GeoJSON: {error}{CUT_OFF}") from None
    if not isinstance(data, dict):
        raise Unusable("is JSON, and not GeoJSON")
    _check_reference(data)
    found = [
        one for number, given in enumerate(_features(data), 1) for one in _of_feature(given, number)
    ]
    refuse_if_many(found)
    heights = sum(1 for given in _features(data) if _has_heights(given.get("geometry")))
    notes = [_HEIGHTS.format(counted(heights, "feature"))] if heights else []
    return Drawing(what=GEOJSON, features=tuple(found), notes=tuple(notes))


_HEIGHTS = (
    "{}: third coordinates are above the ellipsoid, and not taken: say how high in a property height, or altitude"
    " for one above sea level"
)


def _features(data: Mapping[str, Any]) -> Sequence[Mapping[str, Any]]:
    match data.get("type"):
        case "FeatureCollection":
            features = data.get("features")
            if not isinstance(features, list) or not all(isinstance(f, dict) for f in features):
                raise Unusable("has no list of features")
            return features
        case "Feature":
            return [data]
        case str():
            return [{"type": "Feature", "geometry": data, "properties": {}}]
        case _:
            raise Unusable("is JSON, and not GeoJSON: it has no type")


def _check_reference(data: Mapping[str, Any]) -> None:
    """Refuse what is in another reference system, as older files may say."""
    reference = data.get("crs")
    properties = reference.get("properties") if isinstance(reference, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    if isinstance(name, str) and not any(one in name for one in _WGS_84):
        raise Unusable(f"has coordinates of {quoted(name)}: save it in WGS 84, which is EPSG:4326")


def _of_feature(given: Mapping[str, Any], number: int) -> Iterator[Feature]:
    properties = given.get("properties")
    said = properties if isinstance(properties, dict) else {}
    name = next((one for key in _NAMES if (one := name_in(said.get(key)))), None)
    who = called("feature", number, name)
    forbidden = said.get("no_fly") in (True, 1, "true", "yes") or is_no_fly(name, said.get("type"))
    geometries = [*_parts(given.get("geometry"), who, 0)]
    for kind, coordinates in geometries:
        yield _of_geometry(kind, coordinates, who, name, said, forbidden=forbidden)


def _parts(geometry: Any, who: str, depth: int) -> Iterator[tuple[str, Any]]:
    """Yield the plain geometries of one that may have several."""
    if geometry is None:  # a feature may lie nowhere
        return
    if not isinstance(geometry, dict) or depth > 8:
        raise Unusable(f"{who} has no geometry that can be read")
    kind = f"{geometry.get('type')}"
    coordinates = geometry.get("coordinates")
    if kind == "GeometryCollection":
        inner = geometry.get("geometries")
        for one in inner if isinstance(inner, list) else ():
            yield from _parts(one, who, depth + 1)
    elif kind in _PARTS:
        for one in coordinates if isinstance(coordinates, list) else ():
            yield _PARTS[kind], one
    elif kind in _PARTS.values():
        yield kind, coordinates
    else:
        raise Unusable(f"{who} is of no known type of geometry")


def _of_geometry(
    kind: str,
    coordinates: Any,
    who: str,
    name: str | None,
    said: Mapping[str, Any],
    *,
    forbidden: bool,
) -> Feature:
    if kind == "Point":
        spots: tuple[Spot, ...] = (_spot(coordinates, who, said),)
        return Feature(kind=Kind.PLACE, who=who, name=name, spots=spots, said=said)
    if kind == "LineString":
        spots = tuple(_spot(one, who, said) for one in _list(coordinates, who))
        return Feature(kind=Kind.ROUTE, who=who, name=name, spots=spots, said=said)
    rings = _list(coordinates, who)
    around = _list(rings[0] if rings else None, who)
    return Feature(
        kind=Kind.NO_FLY if forbidden else Kind.AREA,
        who=who,
        name=name,
        spots=corners([_spot(one, who, said) for one in around], who),
        has_holes=len(rings) > 1,
        said=said,
    )


def _list(value: Any, who: str) -> list[Any]:
    if not isinstance(value, list):
        raise Unusable(f"{who} has no coordinates that can be read")
    return value


def _spot(position: Any, who: str, said: Mapping[str, Any]) -> Spot:
    """Return a position, which is longitude and latitude, in that order."""
    if not isinstance(position, list) or len(position) < 2:
        raise Unusable(f"{who} has no coordinates that can be read")
    return spot(position[1], position[0], who, said.get("height"), said.get("altitude"))


def _has_heights(geometry: Any) -> bool:
    """Return whether the first position of a geometry has a third coordinate that says something."""
    first = geometry.get("coordinates") if isinstance(geometry, dict) else None
    while isinstance(first, list) and first and isinstance(first[0], list):
        first = first[0]
    return isinstance(first, list) and len(first) > 2 and first[2] not in (0, None)
