"""Missions, trips and results as plain data, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any

from ..domain.fields import Entity
from ..domain.mission_data import MOST_BITS, Data, fields_of, trip_data
from ..domain.model import Item, Photo
from ..domain.status import TripStatus
from ..domain.text import shown
from .keepable import are_named, keepable

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Mission, Point, Trip


def mission_data(app: App, mission: Mission[Any]) -> Data:
    """Return a mission's data with its trips, as its user gave them."""
    return {
        "index": mission.index,
        "fields": fields_of(app, Entity.MISSION, mission),
        "trips": [trip_data(app, trip) for trip in mission.trips],
    }


def trip_of(
    app: App, data: Mapping[str, Any], index: int = 0, status: TripStatus = TripStatus.WAITING
) -> Trip:
    """Return a stored trip, or a new one; raise `KeyError` or `TypeError` if it does not fit the app."""
    app.actions[data["action"]]
    index = data.get("index", index)
    name, target = data.get("name", f"{index + 1}"), point_of(data["target"])
    trip = app.trip(name=name, action=data["action"], target=target, index=index)
    trip.status = status
    if not _LEAST.issuperset(data):  # most new trips have no more
        source = data.get("source")
        trip.source = None if source is None else point_of(source)
        trip.parameters = data.get("parameters") or trip.parameters
        trip.item = item_of(data.get("item"))
        for field, value in known_fields(app, Entity.TRIP, data).items():
            setattr(trip, field, value)
        trip.added, trip.attempt = bool(data.get("added")), data.get("attempt", 1)
        trip.status = TripStatus(data["status"]) if "status" in data else status
        trip.reason = data.get("reason", "")
        trip.start_time, trip.end_time = data.get("start_time"), data.get("end_time")
    return trip


_LEAST = frozenset({"name", "action", "target", "index"})


def known_fields(app: App, entity: Entity, data: Mapping[str, Any]) -> Data:
    """Return the fields that the app has."""
    given = data.get("fields")
    if not given:
        return {}
    names = [field.name for field in app.fields if field.on is entity]
    return {name: given[name] for name in names if name in given}


def point_of(data: Sequence[float]) -> Point:
    """Return a stored point."""
    x, y, z = data
    return x, y, z


def item_of(data: Mapping[str, Any] | None) -> Item | None:
    """Return a stored item."""
    return None if data is None else Item(name=data["name"], mass=data["mass"])


def item_data(item: Item | None) -> Data | None:
    """Return an item as plain data."""
    return None if item is None else {"name": item.name, "mass": item.mass}


def value_data(value: object) -> object:
    """Return an action's result as plain data; what is not plain data becomes text.

    A photo, and what is not plain, becomes an object with one reserved key. What is too large, too
    deep or circular becomes text as a whole.
    """
    kept = keepable(value)
    return _data(value) if kept is value else {"$text": kept}


def _data(value: Any) -> object:
    """Return a value as plain data, without calling its methods."""
    kind = type(value)
    if value is None or kind is bool:
        return value
    if issubclass(kind, int):
        number = int.__pos__(value)
        return {"$text": shown(number)} if number.bit_length() > MOST_BITS else number
    if issubclass(kind, float):
        real = float.__pos__(value)
        return real if isfinite(real) else {"$number": repr(real)}
    if issubclass(kind, str):
        return str.__str__(value)
    if issubclass(kind, list):
        return [_data(part) for part in list.__iter__(value)]
    if issubclass(kind, tuple):
        return {"$tuple": [_data(part) for part in tuple.__iter__(value)]}
    if issubclass(kind, dict) and are_named(items := tuple(dict.items(value))):
        return {str.__str__(name): _data(part) for name, part in items}
    return _photo_data(value) if kind is Photo else {"$text": shown(value)}


def _photo_data(photo: Photo) -> object:
    x, y, z = (float(number) for number in photo.position)
    data: Data = {
        "position": [x, y, z],
        "width": float(photo.width),
        "height": float(photo.height),
        "sees": [str(what) for what in photo.sees],
        "sharpness": float(photo.sharpness),
    }
    if photo.file is not None:  # older journals have no such key
        data["file"] = str(photo.file)
    return {"$photo": data}


def value_of(data: object) -> object:
    """Return a stored result of an action."""
    match data:
        case {"$number": str(text)}:
            return float(text)
        case {"$photo": dict(photo)}:
            return _photo_of(photo)
        case {"$tuple": [*elements]}:
            return tuple(value_of(element) for element in elements)
        case {"$text": str(text)}:
            return text
        case list():
            return [value_of(element) for element in data]
        case dict():
            return {key: value_of(element) for key, element in data.items()}
        case _:
            return data


def _photo_of(photo: Mapping[str, Any]) -> Photo:
    return Photo(
        position=point_of(photo["position"]),
        width=photo["width"],
        height=photo["height"],
        sees=tuple(photo["sees"]),
        sharpness=photo["sharpness"],
        file=photo.get("file"),
    )
