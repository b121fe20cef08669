"""Missions, trips and results as plain data, and back; what cannot be stored as such is stored as its text."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, cast

from ..domain.errors import ANY_ERROR
from ..domain.fields import Entity
from ..domain.guard import unless_by_a_person
from ..domain.keeper import plain_again, put, read_only
from ..domain.model import Item, Photo, Sighting
from ..domain.plain import MOST_BITS, plain_of
from ..domain.status import TripStatus
from ..domain.text import shown

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Mission, Point, Trip

Data = dict[str, Any]  # plain data, as JSON can hold it


def fields_of(app: App, entity: Entity, of: object) -> Data:
    """Return the filled-in fields that the app's graph adds to missions or to trips."""
    found: Data = {}
    for field in app.fields:
        if field.on is entity:
            value = getattr(of, field.name)
            if value is not field.default:
                found[field.name] = _plain(value)
    return found


def trip_data(app: App, trip: Trip) -> Data:
    """Return a trip without the values that every new trip has."""
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
    if given := trip.parameters:
        data["parameters"] = {_plain(name): _plain(value) for name, value in given.items()}
    if trip.item is not None:
        data["item"] = item_data(trip.item)
    if trip.added:
        data["added"] = True
    if trip.attempt != 1:
        data["attempt"] = _plain(trip.attempt)
    if trip.status is not TripStatus.WAITING:
        data["status"] = trip.status.value
    return data


def _plain(value: object) -> object:
    """Return a field's value, as text if a hook set it to something that is not plain data."""
    if value is None or type(value) in _AS_IT_IS or (type(value) is int and abs(value) < _SMALL):
        return value
    if type(value) in _BY_NAME:
        named = cast("Mapping[object, object]", value)
        return {str(_plain(name)): _plain(each) for name, each in named.items()}
    plain = plain_of(value)
    is_long = type(plain) is int and plain.bit_length() > MOST_BITS
    is_odd = plain is None or (type(plain) is float and not isfinite(plain))
    return shown(value) if is_long or is_odd else plain


_AS_IT_IS = (float, str, bool)
_BY_NAME = (dict, MappingProxyType)
_SMALL = 2**53


def _place(point: Sequence[float]) -> list[object]:
    """Return a point, which a hook may have made of anything; raise `TypeError` if it is not one."""
    if not issubclass(type(point), (tuple, list)) or len(point) > _COORDINATES:
        raise TypeError(f"a place is (x, y, z), not {shown(point)[:_COORDINATES * 20]}")
    return [_plain(number) for number in point]


_COORDINATES = 3


def mission_data(app: App, mission: Mission[Any]) -> Data:
    """Return a mission's data with its trips, as its user gave them."""
    return {
        "index": mission.index,
        "fields": fields_of(app, Entity.MISSION, mission),
        "trips": [trip_data(app, trip) for trip in mission.trips],
        **({"promises": plain_again(mission.promises)} if mission.promises else {}),
    }


def trip_of(
    app: App, data: Mapping[str, Any], index: int = 0, status: TripStatus = TripStatus.WAITING
) -> Trip:
    """Return a stored trip, or a new one; raise `KeyError` or `TypeError` if it does not fit the app."""
    app.actions[data["action"]]
    index = data.get("index", index)
    name, target = data.get("name", f"{index + 1}"), point_of(data["target"])
    fields = known_fields(app, Entity.TRIP, data) if "fields" in data else {}
    trip = app.trip(name=name, action=data["action"], target=target, index=index, **fields)
    if not _LEAST.issuperset(data):  # most new trips have no more
        source = data.get("source")
        status = TripStatus(data["status"]) if "status" in data else status
        put(
            trip,
            source=None if source is None else point_of(source),
            parameters=data.get("parameters") or {},
            item=item_of(data.get("item")),
            added=bool(data.get("added")),
            attempt=data.get("attempt", 1),
            reason=data.get("reason", ""),
            start_time=data.get("start_time"),
            end_time=data.get("end_time"),
        )
    put(trip, status=status)
    return trip


_LEAST = frozenset({"name", "action", "target", "index"})


def known_fields(app: App, entity: Entity, data: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the fields that the app has, for hooks to read."""
    given = data.get("fields")
    if not given:
        return {}
    names = [field.name for field in app.fields if field.on is entity]
    return read_only({name: given[name] for name in names if name in given})


def point_of(data: Sequence[float]) -> Point:
    """Return a stored point."""
    x, y, z = data
    return x, y, z


def item_of(data: Mapping[str, Any] | None) -> Item | None:
    """Return a stored item."""
    return None if data is None else Item(name=data["name"], mass=data["mass"])


def item_data(item: Item | None) -> Data | None:
    """Return an item as plain data."""
    return None if item is None else {"name": _plain(item.name), "mass": _plain(item.mass)}


# Results of hooks


def value_data(value: object) -> object:
    """Return an action's result as plain data; what is not plain data becomes text.

    A photo, and what is not plain, becomes an object with one reserved key. What is too large, too
    deep or circular becomes text as a whole.
    """
    try:
        return _Writer().write(value)
    except ANY_ERROR as error:  # its own: a value may be an object of any kind
        unless_by_a_person(error)
        return {"$text": shown(value)}


def keepable(value: object) -> object:
    """Return a hook's result, or its text if it is too large, too deep or circular."""
    try:
        _Writer().write(value)
    except ANY_ERROR as error:  # its own, as above
        unless_by_a_person(error)
        return shown(value)
    return value


_DEEPEST, _MOST, _LONGEST = 50, 300_000, 10_000_000
"""Limits of one value: its depth, its number of parts, its characters."""


class _Writer:
    """Writes one value as plain data, without calling its methods; raises if it is too large."""

    def __init__(self) -> None:
        self._parts = self._characters = 0

    def write(self, value: Any, depth: int = 0) -> object:
        """Return a part of the value as plain data."""
        kind, deeper = type(value), depth + 1
        self._parts += 1
        if depth > _DEEPEST or self._parts > _MOST:
            raise ValueError("too deep, or too many parts")
        if issubclass(kind, list):
            return [self.write(part, deeper) for part in list.__iter__(value)]
        if issubclass(kind, tuple):
            return {"$tuple": [self.write(part, deeper) for part in tuple.__iter__(value)]}
        if issubclass(kind, dict) and _are_named(items := tuple(dict.items(value))):
            return {self._text(name): self.write(part, deeper) for name, part in items}
        if kind is Photo:
            return {"$photo": self._photo(value)}
        known = plain_of(value)
        if type(known) is float and not isfinite(known):
            return {"$number": repr(known)}
        plain = shown(value) if issubclass(kind, dict) else _plain(value)
        if type(plain) is not str:
            return plain
        text = self._text(plain)
        return text if type(known) is str else {"$text": text}

    def _text(self, value: str) -> str:
        self._characters += str.__len__(value)
        if self._characters > _LONGEST:
            raise ValueError("too many characters")
        return str.__str__(value)

    def _photo(self, photo: Photo) -> Data:
        x, y, z = (float(number) for number in photo.position)
        data: Data = {
            "position": [x, y, z],
            "width": float(photo.width),
            "height": float(photo.height),
            "sees": [self._text(str(what)) for what in photo.sees],
            "sharpness": float(photo.sharpness),
        }
        if photo.tracks:
            data["tracks"] = [[one.track, one.kind, [*one.at]] for one in photo.tracks]
        if photo.file is not None:
            data["file"] = self._text(str(photo.file))
        return data


def _are_named(items: Iterable[tuple[Any, Any]]) -> bool:
    """Return whether these are values by name, with no name reserved by the journal."""
    return all(issubclass(type(name), str) and not str.startswith(name, "$") for name, _ in items)


def value_of(data: object) -> object:
    """Return a stored result of an action."""
    if data is None:  # most actions give none
        return None
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
        tracks=tuple(
            Sighting(track, kind, point_of(at)) for track, kind, at in photo.get("tracks", ())
        ),
        sharpness=photo["sharpness"],
        file=photo.get("file"),
    )
