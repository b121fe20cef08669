"""Missions and trips as plain data, after a hook has changed them."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, log10
from typing import TYPE_CHECKING, Any, cast

from .fields import Entity
from .status import TripStatus
from .text import MOST_DIGITS, shown

if TYPE_CHECKING:
    from .app import App
    from .model import Mission, Trip

Data = dict[str, Any]
"""Plain data, as JSON can hold it."""


def fields_of(app: App, entity: Entity, of: object) -> Data:
    """Return the filled-in fields that the app's graph adds to missions or to trips."""
    given = {field: getattr(of, field.name) for field in app.fields if field.on is entity}
    return {f.name: _plain(value) for f, value in given.items() if value is not f.default}


def change_data(app: App, mission: Mission[Any]) -> Data:
    """Return the state of a mission that a hook has changed."""
    return {
        "mission": mission.name,
        "todo": [trip_data(app, trip) for trip in mission.trips],
        "done": [trip_data(app, trip) for trip in mission.completed_trips],
        "fields": fields_of(app, Entity.MISSION, mission),
    }


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


def _plain(value: object) -> object:
    """Return a field's value, as text if a hook set it to something that is not plain data."""
    kind = type(value)
    if kind in _SIMPLE:
        return value
    if issubclass(kind, int):
        number = int.__pos__(cast("int", value))
        return number if number.bit_length() <= MOST_BITS else shown(value)
    if issubclass(kind, float):
        real = float.__pos__(cast("float", value))
        return real if isfinite(real) else shown(value)
    return str.__str__(cast("str", value)) if issubclass(kind, str) else shown(value)


_SIMPLE = (type(None), bool, float, str)
MOST_BITS = int(MOST_DIGITS / log10(2))
"""Bits of a number; a longer one is kept as text."""


def _place(point: Sequence[float]) -> list[object]:
    """Return a point, which a hook may have made of anything; raise `TypeError` if it is not one."""
    if not issubclass(type(point), (tuple, list)) or len(point) > _COORDINATES:
        raise TypeError(f"a place is (x, y, z), not {shown(point)[:_COORDINATES * 20]}")
    return [_plain(number) for number in point]


_COORDINATES = 3
