"""Missions, trips and results as plain data, and back: what the journal keeps of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, log10
from typing import TYPE_CHECKING, Any, cast

from ..fields import Entity
from ..kernel import WHATEVER
from ..model import NOTHING, Item, Photo
from ..raised import by_a_person
from ..status import TripStatus
from ..words import MOST_DIGITS, shown

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


def change_data(app: App, mission: Mission[Any]) -> Data:
    """Return how a mission is now that a hook has changed it."""
    return {
        "mission": mission.name,
        "todo": [trip_data(app, trip) for trip in mission.trips],
        "done": [trip_data(app, trip) for trip in mission.completed_trips],
        "fields": fields_of(app, Entity.MISSION, mission),
    }


def trip_data(app: App, trip: Trip) -> Data:
    """Return a trip as it stands; what is as with every new trip is left out."""
    data: Data = {
        "name": _plain(trip.name),
        "action": _plain(trip.action),
        "target": _place(trip.target),
        "index": _plain(trip.index),
    }
    fields = fields_of(app, Entity.TRIP, trip)
    if fields:
        data["fields"] = fields
    if trip.source is not None:
        data["source"] = _place(trip.source)
    if trip.parameters:
        data["parameters"] = {
            _plain(name): _plain(value) for name, value in trip.parameters.items()
        }
    if trip.item is not None:
        data["item"] = {"name": _plain(trip.item.name), "mass": _plain(trip.item.mass)}
    if trip.added:
        data["added"] = True
    if trip.attempt != 1:
        data["attempt"] = _plain(trip.attempt)
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
    mistaken for. What is too large, too deep or goes round in a circle is text as a whole.
    """
    try:
        return _Keeping().data(value)
    except WHATEVER as error:  # its own: a value may be an object of any kind
        if by_a_person(error):
            raise
        return {"$text": shown(value)}


def keepable(value: object) -> object:
    """Return what a hook gave as the runtime takes it in: itself, or its text if it cannot be kept."""
    try:
        if type(value) not in _HARMLESS:
            _Keeping().data(value)
    except WHATEVER as error:
        if by_a_person(error):
            raise
        return shown(value)
    return value


_HARMLESS = (type(None), bool, float)

_DEEPEST, _MOST, _LONGEST = 50, 300_000, 10_000_000
"""Of one value: how deep lists may lie in lists, how many parts it has, how many characters."""


class _TooMuch(Exception):
    """It cannot be kept as plain data."""


class _Keeping:
    """One value on its way into the journal."""

    def __init__(self) -> None:
        self._parts, self._characters = 0, 0

    def data(self, value: object, depth: int = 0) -> object:
        """Return it as plain data; its class may be any, and is asked nothing."""
        self._parts += 1
        if depth > _DEEPEST or self._parts > _MOST:
            raise _TooMuch
        kind = type(value)
        if value is None or kind is bool:
            return value
        if issubclass(kind, int):
            number = int.__pos__(cast("int", value))
            return {"$text": shown(number)} if number.bit_length() > _BITS else number
        if issubclass(kind, float):
            real = float.__pos__(cast("float", value))
            return real if isfinite(real) else {"$number": repr(real)}
        if issubclass(kind, str):
            return self._text(cast("str", value))
        if issubclass(kind, list):
            return [self.data(part, depth + 1) for part in list.__iter__(cast("Any", value))]
        if issubclass(kind, tuple):
            parts = tuple.__iter__(cast("Any", value))
            return {"$tuple": [self.data(part, depth + 1) for part in parts]}
        if issubclass(kind, dict):
            return self._object(cast("dict[object, object]", value), depth)
        if isinstance(value, Photo) and kind is Photo:
            return _photo_data(value)
        return {"$text": self._text(shown(value))}

    def _text(self, value: str) -> str:
        text = str.__str__(value)
        self._characters += len(text)
        if self._characters > _LONGEST:
            raise _TooMuch
        return text

    def _object(self, value: dict[object, object], depth: int) -> object:
        items = list(dict.items(value))
        if not all(issubclass(type(key), str) for key, _ in items):
            return {"$text": self._text(shown(value))}
        named = {self._text(cast("str", key)): part for key, part in items}
        if any(name[:1] == "$" for name in named):
            return {"$text": self._text(shown(value))}
        return {name: self.data(part, depth + 1) for name, part in named.items()}


_BITS = int(MOST_DIGITS / log10(2))


def _photo_data(photo: Photo) -> object:
    x, y, z = (float(number) for number in photo.position)
    data: Data = {
        "position": [x, y, z],
        "width": float(photo.width),
        "height": float(photo.height),
        "sees": [str(what) for what in photo.sees],
        "sharpness": float(photo.sharpness),
    }
    if photo.file is not None:  # journals from before know no such thing
        data["file"] = str(photo.file)
    return {"$photo": data}


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
    if type(value) in _SIMPLE:
        return value
    kept = value_data(value)
    return kept if kept is None or isinstance(kept, (bool, int, float, str)) else shown(value)


_SIMPLE = (type(None), bool, float, str)


def _place(point: Sequence[float]) -> list[object]:
    """Return a place, which a hook may have made of anything; TypeError: it is no place at all."""
    if not issubclass(type(point), (tuple, list)) or len(point) > _COORDINATES:
        raise TypeError(f"a place is (x, y, z), not {shown(point)[:_COORDINATES * 20]}")
    return [_plain(number) for number in point]


_COORDINATES = 3
