"""Results as files for other programs: CSV (RFC 4180) and GeoJSON (RFC 7946)."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Iterator, Sequence
from datetime import UTC, datetime
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from .flights import Brought, FlightResults

if TYPE_CHECKING:
    from ...geodesy import Degrees
    from ..wire import PhotoValue

COLUMNS = (
    *("number", "time", "wall", "mission", "trip", "round", "attempt", "drone", "kind"),
    *("action", "place", "x", "y", "z", "quantity", "value", "unit", "tags"),
    *("width", "height", "sharpness", "picture", "drained"),
    *("latitude", "longitude", "altitude"),
)
"""The columns of a table; `docs/files.md` says what they hold."""

BOM = "\ufeff"
"""Begins a CSV file, so that spreadsheets read it as UTF-8."""

_FORMULA = (*"=+-@", *"＝＋－＠", *"\t\r\n", "'")
"""What makes a spreadsheet take a text for a formula, or marks one that would."""

TAGS_APART = "; "

DIGITS = 8
"""Of degrees: a millimetre."""

Cells = dict[str, str | int | float | bool | None]


def cells(flight: FlightResults) -> Iterator[Cells]:
    """Yield a row of the table for each value: several for a result of several, one for one of none."""
    for one in flight.rows:
        row = _common(flight, one)
        for number in one.result["values"]:
            unit, value = number["unit"], number["value"]
            yield {**row, "quantity": number["quantity"], "value": value, "unit": unit}
        if not one.result["values"]:
            yield row


def _common(flight: FlightResults, one: Brought) -> Cells:
    result, value = one.result, one.value
    photo: PhotoValue | None = value if result["kind"] == "photo" else None
    at: Sequence[float | None] = (
        photo["position"] if photo else result["at"] or result["target"] or ()
    )
    x, y, z = (*at, None, None, None)[:3]
    file = flight.pictures.get(result["number"])
    return {
        "number": result["number"],
        "time": result["time"],
        "wall": datetime.fromtimestamp(one.wall, UTC).isoformat(timespec="milliseconds"),
        "mission": result["mission"],
        "trip": result["trip"],
        "round": result["round"],
        "attempt": result["attempt"],
        "drone": result["drone"],
        "kind": result["kind"],
        "action": result["action"],
        "place": result["place"],
        "x": x,
        "y": y,
        "z": z,
        "quantity": None,
        "value": None if photo else _plain(value),
        "unit": None,
        "tags": TAGS_APART.join(photo["sees"] if photo else result["tags"]),
        "width": photo["width"] if photo else None,
        "height": photo["height"] if photo else None,
        "sharpness": photo["sharpness"] if photo else None,
        "picture": picture_name(result["number"], file) if file is not None else None,
        "drained": result["drained"],
        **_on_earth(place_of(flight, at)),
    }


def place_of(flight: FlightResults, at: Sequence[float | None]) -> Degrees | None:
    """Return where something on the map is on the Earth: latitude, longitude, and altitude above sea level.

    None: the map does not lie there, or that is not known.
    """
    x, y, z = (*at, None, None, None)[:3]
    if flight.plane is None or x is None or y is None:
        return None
    try:
        return flight.plane.to_degrees((x, y, z or 0.0))
    except ValueError:  # a hook may return any place
        return None


def _on_earth(place: Degrees | None) -> Cells:
    latitude, longitude, altitude = (None, None, None) if place is None else place
    return {
        "latitude": None if latitude is None else round(latitude, DIGITS),
        "longitude": None if longitude is None else round(longitude, DIGITS),
        "altitude": None if altitude is None else round(altitude, 3),
    }


def picture_name(number: int, file: str) -> str:
    """Return what the picture of a result is called in an archive: `00007.jpg`."""
    return f"{number:05}{PurePath(file).suffix.lower()}"


def _plain(value: Any) -> str | int | float | bool | None:
    if isinstance(value, list | dict):
        return json.dumps(value, ensure_ascii=False)
    plain: str | int | float | bool | None = value
    return plain


def csv_text(rows: Iterable[Cells]) -> str:
    """Return a table as CSV: lines end with CR LF, texts are safe against being taken for formulas."""
    text = io.StringIO(newline="")
    text.write(BOM)
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(COLUMNS)
    for row in rows:
        writer.writerow([_cell(row[name]) for name in COLUMNS])
    return text.getvalue()


def _cell(value: str | float | bool | None) -> str | int | float:
    match value:
        case None:
            return ""
        case bool():
            return "true" if value else "false"
        case str() if value.startswith(_FORMULA):
            return f"'{value}"
        case _:
            return value


def geojson(flight: FlightResults, app: str) -> dict[str, object]:
    """Return the results that have a place: photos as the ground that they show, others as points.

    In degrees, if the map lies on the Earth, else in its metres.
    """
    coordinates = "metres of the map, not degrees: x and y along its sides, z above its ground"
    if flight.plane is not None:
        coordinates = "degrees of WGS 84 (EPSG:4326): longitude and latitude"
    rows = (row for row in cells(flight) if row["x"] is not None)
    return {
        "type": "FeatureCollection",
        "pluto": {"app": app, "flight": flight.flight, "coordinates": coordinates},
        "features": [_feature(flight, row) for row in rows],
    }


def _feature(flight: FlightResults, row: Cells) -> dict[str, object]:
    left_out = ("latitude", "longitude") if flight.plane else ("x", "y", "z", *_on_earth(None))
    properties: dict[str, object] = {n: row[n] for n in COLUMNS if n not in left_out}
    tags = str(properties["tags"])
    properties["tags"] = tags.split(TAGS_APART) if tags else []
    point = [row[name] for name in ("x", "y", "z") if row[name] is not None]
    if flight.plane:
        point = [row["longitude"], row["latitude"]]
    geometry: dict[str, object] = {"type": "Point", "coordinates": point}
    if row["kind"] == "photo":
        properties["position"] = point
        geometry = {"type": "Polygon", "coordinates": [_ground(flight, row)]}
    return {
        "type": "Feature",
        "id": row["number"],
        "geometry": geometry if None not in point else None,
        "properties": properties,
    }


def _ground(flight: FlightResults, row: Cells) -> list[list[float | None]]:
    """Return the corners of what a photo shows, counter-clockwise, the first once more."""
    x, y, width, height = (float(row[name] or 0) for name in ("x", "y", "width", "height"))
    left, right, low, high = x - width / 2, x + width / 2, y - height / 2, y + height / 2
    ring = [(left, low), (right, low), (right, high), (left, high), (left, low)]
    if flight.plane is None:
        return [[x, y] for x, y in ring]
    return [
        [None if place is None else round(place[axis], DIGITS) for axis in (1, 0)]
        for place in (place_of(flight, corner) for corner in ring)
    ]
