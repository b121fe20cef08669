"""Writing drawings for other programs: GeoJSON, KML, a plan of QGroundControl, a list of places."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from io import StringIO
from itertools import pairwise
from typing import Any
from xml.sax.saxutils import escape

from .feature import Feature, Kind, Spot

_DIGITS = 9
"""Of degrees: a tenth of a millimetre."""
_WAYPOINT = 16
_TAKEOFF = 22
_RTL = 20
_PHOTO = 2000
_RELATIVE = 3
_NO_PLACE = 2


def geojson_text(features: Sequence[Feature]) -> str:
    """Return features as GeoJSON (RFC 7946); heights are properties, as they are not above the ellipsoid."""
    found = [
        {
            "type": "Feature",
            "geometry": _geometry(one),
            "properties": {"name": one.name, **_heights(one), **_forbidden(one), **one.said},
        }
        for one in features
    ]
    return json.dumps(
        {"type": "FeatureCollection", "features": found}, indent=1, ensure_ascii=False
    )


def _geometry(feature: Feature) -> dict[str, Any]:
    at = [position(one) for one in feature.spots]
    match feature.kind:
        case Kind.PLACE:
            return {"type": "Point", "coordinates": at[0]}
        case Kind.ROUTE:
            return {"type": "LineString", "coordinates": at}
        case _:
            return {"type": "Polygon", "coordinates": [ring(at)]}


def position(spot: Spot) -> list[float]:
    """Return a spot as GeoJSON has it: longitude and latitude."""
    return [round(spot.longitude, _DIGITS), round(spot.latitude, _DIGITS)]


def ring(corners: Sequence[list[float]]) -> list[list[float]]:
    """Return an outline as GeoJSON has it: counter-clockwise, the first corner once more at the end."""
    around = [*corners, corners[0]]
    turns = sum((b[0] - a[0]) * (b[1] + a[1] - 2 * corners[0][1]) for a, b in pairwise(around))
    return around[::-1] if turns > 0 else around


def _forbidden(feature: Feature) -> Mapping[str, bool]:
    return {"no_fly": True} if feature.kind is Kind.NO_FLY else {}


def _heights(feature: Feature) -> Mapping[str, float]:
    if feature.kind is not Kind.PLACE:
        return {}
    spot = feature.spots[0]
    given = {"height": spot.height, "altitude": spot.altitude}
    return {key: round(value, 4) for key, value in given.items() if value is not None}


def kml_text(features: Sequence[Feature]) -> str:
    """Return features as KML 2.2."""
    return "\n".join(_kml(features)) + "\n"


def _kml(features: Sequence[Feature]) -> Iterator[str]:
    yield '<?xml version="1.0" encoding="UTF-8"?>'
    yield '<kml xmlns="http://www.opengis.net/kml/2.2">'
    yield "<Document>"
    for one in features:
        yield "<Placemark>"
        if one.name:
            yield f"<name>{escape(one.name)}</name>"
        said = {**one.said, **({"no_fly": "true"} if one.kind is Kind.NO_FLY else {})}
        if said:
            yield "<ExtendedData>"
            for key, value in said.items():
                name = escape(key, {'"': "&quot;"})
                yield f'<Data name="{name}"><value>{escape(f"{value}")}</value></Data>'
            yield "</ExtendedData>"
        yield from _kml_geometry(one)
        yield "</Placemark>"
    yield "</Document>"
    yield "</kml>"


def _kml_geometry(feature: Feature) -> Iterator[str]:
    if feature.kind in (Kind.AREA, Kind.NO_FLY):
        spots = [*feature.spots, feature.spots[0]]
        at = " ".join(f"{x!r},{y!r}" for x, y in map(position, spots))
        yield f"<Polygon><outerBoundaryIs><LinearRing><coordinates>{at}</coordinates></LinearRing>"
        yield "</outerBoundaryIs></Polygon>"
        return
    first = feature.spots[0]
    mode = "clampToGround"
    up = [0.0] * len(feature.spots)
    if first.height is not None:
        mode = "relativeToGround"
        up = [one.height or 0.0 for one in feature.spots]
    elif first.altitude is not None:
        mode = "absolute"
        up = [one.altitude or 0.0 for one in feature.spots]
    at = " ".join(
        f"{x!r},{y!r},{z:g}" for (x, y), z in zip(map(position, feature.spots), up, strict=True)
    )
    kind = "Point" if feature.kind is Kind.PLACE else "LineString"
    yield f"<{kind}><altitudeMode>{mode}</altitudeMode><coordinates>{at}</coordinates></{kind}>"


def plan_text(features: Sequence[Feature]) -> str:
    """Return the places and ways of features as one mission of QGroundControl, in their order."""
    spots = [
        (spot, one.said.get("action"))
        for one in features
        if one.kind in (Kind.PLACE, Kind.ROUTE)
        for spot in one.spots
    ]
    items = [_item(_TAKEOFF, [0, 0, 0, None, *_at(spots[0][0])])] if spots else []
    for spot, action in spots:
        items.append(_item(_WAYPOINT, [0, 0, 0, None, *_at(spot)]))
        if action == "take_photo":
            items.append(_item(_PHOTO, [0, 0, 1, 0, None, None, None], _NO_PLACE))
    if spots:
        items.append(_item(_RTL, [0] * 7, _NO_PLACE))
    for number, item in enumerate(items, 1):
        item["doJumpId"] = number
    polygons = [
        {"inclusion": False, "polygon": [_at(at)[:2] for at in one.spots], "version": 1}
        for one in features
        if one.kind is Kind.NO_FLY
    ]
    home = [*_at(spots[0][0])[:2], 0] if spots else [0, 0, 0]
    plan = {
        "fileType": "Plan",
        "geoFence": {"circles": [], "polygons": polygons, "version": 2},
        "groundStation": "QGroundControl",
        "mission": {
            "cruiseSpeed": 15,
            "firmwareType": 12,
            "globalPlanAltitudeMode": 1,
            "hoverSpeed": 5,
            "items": items,
            "plannedHomePosition": home,
            "vehicleType": 2,
            "version": 2,
        },
        "rallyPoints": {"points": [], "version": 2},
        "version": 1,
    }
    return json.dumps(plan, indent=4) + "\n"


def _at(spot: Spot) -> list[float]:
    longitude, latitude = position(spot)
    return [latitude, longitude, round(spot.height or 0.0, 4)]


def _item(command: int, params: list[Any], frame: int = _RELATIVE) -> dict[str, Any]:
    item = {"autoContinue": True, "command": command, "frame": frame, "params": params}
    if frame == _RELATIVE:
        item |= {"AMSLAltAboveTerrain": None, "Altitude": params[6], "AltitudeMode": 1}
    return {**item, "type": "SimpleItem"}


def list_text(features: Sequence[Feature]) -> str:
    """Return the places of features as CSV, a row each."""
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\r\n")
    keys = [*dict.fromkeys(key for one in features for key in one.said)]
    writer.writerow(["name", "latitude", "longitude", "height", *keys])
    for one in features:
        if one.kind is Kind.PLACE:
            latitude, longitude, height = _at(one.spots[0])
            rest = [one.said.get(key, "") for key in keys]
            writer.writerow([one.name or "", latitude, longitude, height, *rest])
    return text.getvalue()


WRITERS: dict[str, Callable[[Sequence[Feature]], str]] = {
    ".geojson": geojson_text,
    ".kml": kml_text,
    ".plan": plan_text,
    ".csv": list_text,
}
"""By how the names of files end."""
