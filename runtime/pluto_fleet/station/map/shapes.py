"""The map as pages get it and send it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...files.landmarks import read_landmarks
from ...files.landmarks_text import landmark_tables
from ...files.reading import Document, PlanTable
from ...shared.domain.errors import BadInput

if TYPE_CHECKING:
    from ...files.landmarks import Landmarks
    from ...files.landmarks import Picture as FloorPlan
    from ...shared.domain.airspace import Airspace
    from ..wire import Picture, Place, Zone

_DIGITS = 3
"""What is drawn is kept to a millimetre, and to a thousandth of a degree."""


def places_of(landmarks: Landmarks) -> list[Place]:
    """Return the named places for pages."""
    found: list[Place] = []
    for one in landmarks.places:
        x, y, *height = one.at
        place: Place = {"name": one.name, "x": x, "y": y}
        found.append({**place, "z": height[0]} if height else place)
    return found


def zones_of(landmarks: Landmarks) -> list[Zone]:
    """Return the zones for pages."""
    return [
        {"name": one.name, "corners": [[x, y] for x, y in one.corners]} for one in landmarks.zones
    ]


def picture_of(picture: FloorPlan, address: str) -> Picture:
    """Return where the floor plan lies for pages."""
    (x, y), (width, height) = picture.at, picture.size
    return {
        "address": address,
        "x": x,
        "y": y,
        "width": width,
        "height": height,
        "turn": picture.turn,
    }


def landmarks_from(given: Mapping[str, object], was: Landmarks, airspace: Airspace) -> Landmarks:
    """Return what a page has drawn; what it does not send stays. Raises `BadInput` with all that is wrong."""
    for key in given:
        if key not in ("places", "zones", "north", "image"):
            raise BadInput(f"the map has no {key}: it has places, zones, north and image")
    data: dict[str, object] = {"north": was.north, **landmark_tables(was)}
    if "places" in given:
        data["places"] = [_place(one) for one in _list(given["places"], "places")]
    if "zones" in given:
        data["zones"] = [_rounded(one) for one in _list(given["zones"], "zones")]
    if "north" in given:
        data["north"] = _rounded(given["north"])
    if given.get("image") is not None:
        data["image"] = _image(given["image"], was.picture)
    document = Document("", {"map": data})
    landmarks = read_landmarks(PlanTable(document, data, ("map",), "the map"), airspace)
    document.refuse_if_bad()
    return landmarks if "image" in given else replace(landmarks, picture=was.picture)


def _place(given: object) -> object:
    """Return a place as in a file."""
    if not isinstance(given, dict):
        return given
    at = [given[key] for key in ("x", "y") if key in given]
    at += [given["z"]] if given.get("z") is not None else []
    rest = {key: value for key, value in given.items() if key not in ("x", "y", "z")}
    return {**rest, "at": _rounded(at)}


def _image(given: object, known: FloorPlan | None) -> dict[str, object]:
    """Return the floor plan as in a file: a page says where it lies, and not which it is."""
    if known is None:
        raise BadInput("the map has no floor plan yet: send its picture first")
    if not isinstance(given, dict):
        raise BadInput("image must be null, or say where the floor plan lies")
    x, y, width, height = (given.get(key) for key in ("x", "y", "width", "height"))
    of_file = {"at": [x, y], "size": [width, height], "turn": given.get("turn", 0.0)}
    return {"file": known.file, **{key: _rounded(value) for key, value in of_file.items()}}


def _list(given: object, name: str) -> list[Any]:
    if not isinstance(given, list) or not all(isinstance(one, dict) for one in given):
        raise BadInput(f"{name} must be a list of objects")
    return given


def _rounded(given: object) -> object:
    match given:
        case float():
            return round(given, _DIGITS) + 0.0
        case list():
            return [_rounded(one) for one in given]
        case dict():
            return {key: _rounded(one) for key, one in given.items()}
        case _:
            return given
