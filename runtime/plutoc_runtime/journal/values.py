"""Missions, trips and results as plain data, and back: what the journal keeps of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any

from ..fields import Entity
from ..model import NOTHING, Item, Photo
from ..status import TripStatus
from ..words import shown

if TYPE_CHECKING:
    from ..app import App
    from ..model import Mission, Point, Trip

Data = dict[str, Any]
"""Plain data, as JSON can hold it."""


def fields_of(app: App, entity: Entity, of: object) -> Data:
    """Return what is filled in of the fields that the app's graph adds to missions or to trips."""
    given = {field: getattr(of, field.name) for field in app.fields if field.on is entity}
    return {f.name: _plain(value) for f, value in given.items() if value is not f.default}


def mission_data(app: App, mission: Mission[Any]) -> Data:
    """Return everything that its user said of a mission, and its trips."""
    return {
        "index": mission.index,
        "fields": fields_of(app, Entity.MISSION, mission),
        "trips": [trip_data(app, trip) for trip in mission.trips],
    }


def trip_data(app: App, trip: Trip) -> Data:
    """Return a trip as it stands; what is as with every new trip is left out."""
    data: Data = {
        "name": trip.name,
        "action": trip.action,
        "target": list(trip.target),
        "index": trip.index,
    }
    fields = fields_of(app, Entity.TRIP, trip)
    if fields:
        data["fields"] = fields
    if trip.source is not None:
        data["source"] = list(trip.source)
    if trip.parameters:
        data["parameters"] = {str(name): _plain(value) for name, value in trip.parameters.items()}
    if trip.item is not None:
        data["item"] = {"name": trip.item.name, "mass": trip.item.mass}
    if trip.added:
        data["added"] = True
    if trip.attempt != 1:
        data["attempt"] = trip.attempt
    if trip.status is not TripStatus.WAITING:
        data["status"] = trip.status.value
    return data


def trip_of(app: App, data: Mapping[str, Any], status: TripStatus = TripStatus.WAITING) -> Trip:
    """Return the trip that was written down; raise KeyError or TypeError if the app has none such."""
    app.actions[data["action"]]
    trip = app.trip(
        name=data["name"],
        action=data["action"],
        target=point_of(data["target"]),
        source=None if data.get("source") is None else point_of(data["source"]),
        parameters=data.get("parameters") or NOTHING,
        item=item_of(data.get("item")),
        index=data["index"],
        **data.get("fields", {}),
    )
    trip.added = bool(data.get("added"))
    trip.attempt = data.get("attempt", 1)
    trip.status = TripStatus(data["status"]) if "status" in data else status
    trip.reason = data.get("reason", "")
    trip.start_time, trip.end_time = data.get("start_time"), data.get("end_time")
    return trip


def point_of(data: Sequence[float]) -> Point:
    """Return a place that was written down."""
    x, y, z = data
    return x, y, z


def item_of(data: Mapping[str, Any] | None) -> Item | None:
    """Return an item that was written down."""
    return None if data is None else Item(name=data["name"], mass=data["mass"])


def item_data(item: Item | None) -> Data | None:
    """Return an item as plain data."""
    return None if item is None else {"name": item.name, "mass": item.mass}


def value_data(value: object) -> object:
    """Return what an action gave as plain data; what is no plain data is kept as text.

    A photo, and what is not plain, becomes an object with one key that no result of plain data is
    mistaken for.
    """
    match value:
        case None | bool() | int() | str():
            return value
        case float():
            return value if isfinite(value) else {"$number": repr(value)}
        case Photo():
            photo: Data = {
                "position": list(value.position),
                "width": value.width,
                "height": value.height,
                "sees": list(value.sees),
                "sharpness": value.sharpness,
            }
            if value.file is not None:  # journals from before know no such thing
                photo["file"] = value.file
            return {"$photo": photo}
        case list():
            return [value_data(element) for element in value]
        case tuple():
            return {"$tuple": [value_data(element) for element in value]}
        case dict() if all(isinstance(key, str) and key[:1] != "$" for key in value):
            return {key: value_data(element) for key, element in value.items()}
        case _:
            return {"$text": shown(value)}


def value_of(data: object) -> object:
    """Return what an action gave from what was written down."""
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


def _plain(value: object) -> object:
    """Return what its user or a hook gave a field, as text if a hook gave it something odd."""
    return value if value is None or isinstance(value, (bool, int, float, str)) else shown(value)
