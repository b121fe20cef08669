"""The schema of a plan as pages send it: a plan that fits is stored, complete or not.

Whether it can be flown is checked in `problems`: a plan is drawn step by step, and a name typed letter by
letter.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING

from ...files.reading import listed
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity
from ...shared.domain.text import quoted
from ...shared.domain.values import shown

if TYPE_CHECKING:
    from ...app import App

Shape = dict[str, object]
"""A mission or a trip as JSON."""

MOST_MISSIONS, MOST_TRIPS = 1_000, 10_000
MOST_PARAMETERS = 64
LONGEST_TEXT = 1_000
LARGEST = 1e15
"""The largest integer that is exact in a browser."""

MISSION_KEYS = ("key", "name", "launched", "ended", "done", "opens", "deadline", "after", "trips")
MOMENTS = ("opens", "deadline")
"""When a mission may begin, and when it is due: in a file they are its window, or its deadline."""
TRIP_KEYS = ("key", "name", "action", "target", "source", "parameters", "item")
"""The keys of every app's trips; the graph adds more."""

COMPLETED, BROKEN_OFF = "COMPLETED", "BROKEN_OFF"
ENDS = (COMPLETED, "FAILED", "CANCELLED", BROKEN_OFF)
"""The final statuses of a mission's last flight, if it has not changed since."""

KEY = re.compile(r"[A-Za-z0-9_-]{8,32}")


def missions_from(given: object, app: App) -> list[Shape]:
    """Return missions in a normal form; raise `BadInput` if they do not fit the schema."""
    elements = _list(given, "missions")
    if len(elements) > MOST_MISSIONS:
        raise _too_many("missions", MOST_MISSIONS)
    missions = [_mission(one, f"mission {i}", app) for i, one in enumerate(elements, 1)]
    check_together(missions)
    return missions


def trips_from(given: object, app: App) -> list[Shape]:
    """Return a mission's trips in a normal form; raise `BadInput` if they do not fit the schema."""
    elements = _list(given, "trips")
    if len(elements) > MOST_TRIPS:
        raise _too_many("trips", MOST_TRIPS)
    return [_trip(one, f"trip {i}", app) for i, one in enumerate(elements, 1)]


def check_together(missions: Sequence[Shape]) -> None:
    """Raise `BadInput` if there are too many, or two have the same key."""
    if len(missions) > MOST_MISSIONS:
        raise _too_many("missions", MOST_MISSIONS)
    keys = [str(one["key"]) for mission in missions for one in (mission, *trips_of(mission))]
    if len(keys) - len(missions) > MOST_TRIPS:
        raise _too_many("trips", MOST_TRIPS)
    seen: set[str] = set()
    for key in keys:
        if key in seen:
            raise BadInput(f"two missions or trips have the key {quoted(key)}")
        seen.add(key)


def trips_of(mission: Mapping[str, object]) -> Sequence[Shape]:
    """Return a mission's trips."""
    trips = mission["trips"]
    return trips if isinstance(trips, list) else ()


def fields_of(app: App, entity: Entity) -> list[str]:
    """Return the names of the fields that the graph adds."""
    return [field.name for field in app.fields if field.on is entity]


def _mission(given: object, who: str, app: App) -> Shape:
    fields = fields_of(app, Entity.MISSION)
    data = _table(given, who, (*MISSION_KEYS, *fields))
    if data.get("launched") is not None and not isinstance(data["launched"], bool):
        raise _wrong(f"{who}: launched", data["launched"], "true or false")
    if data.get("ended") not in (None, *ENDS):
        raise _wrong(f"{who}: ended", data["ended"], " or ".join(ENDS))
    done_by(data, who)
    trips = _list(_given(data, "trips", who), f"{who}: trips")
    return {
        "key": _key(data, who),
        "name": _text(_given(data, "name", who), f"{who}: name"),
        "launched": False,  # neither can be set by pages, nor what was done
        "ended": None,
        **_scalars(data, [*MOMENTS, *fields], who),
        **_after(data, who),
        "trips": [_trip(one, f"{who}, trip {i}", app) for i, one in enumerate(trips, 1)],
    }


def done_by(data: Mapping[str, object], who: str) -> list[str]:
    """Return the names of the trips that a mission has done; raise `BadInput` if that is no list of texts."""
    names = [] if data.get("done") is None else _list(data["done"], f"{who}: done")
    if len(names) > MOST_TRIPS:
        raise _too_many("trips", MOST_TRIPS)
    return [_text(name, f"{who}: done") for name in names]


def _after(data: Mapping[str, object], who: str) -> Shape:
    names = [] if data.get("after") is None else _list(data["after"], f"{who}: after")
    if len(names) > MOST_MISSIONS:
        raise _too_many("missions", MOST_MISSIONS)
    found = [_text(name, f"{who}: after") for name in names]
    return {"after": found} if found else {}


def _trip(given: object, who: str, app: App) -> Shape:
    fields = fields_of(app, Entity.TRIP)
    data = _table(given, who, (*TRIP_KEYS, *fields))
    trip: Shape = {"key": _key(data, who)}
    if data.get("name") is not None:
        trip["name"] = _text(data["name"], f"{who}: name")
    trip["action"] = _text(_given(data, "action", who), f"{who}: action")
    trip["target"] = _place(data.get("target"), f"{who}: target")
    if data.get("source") is not None:
        trip["source"] = _place(data["source"], f"{who}: source")
    trip["parameters"] = _parameters(data.get("parameters"), f"{who}: parameters")
    trip["item"] = _item(data.get("item"), f"{who}: item")
    return {**trip, **_scalars(data, fields, who)}


def _parameters(given: object, who: str) -> Shape:
    data = {} if given is None else _object(given, who)
    if len(data) > MOST_PARAMETERS:
        raise _too_many("parameters for an action", MOST_PARAMETERS)
    names = [_text(name, f"{who}: a name") for name in data]
    return _scalars(data, names, who)


def _item(given: object, who: str) -> Shape | None:
    if given is None:
        return None
    return _scalars(_table(given, who, ("name", "mass")), ("name", "mass"), who)


def _place(given: object, who: str) -> list[object] | None:
    if given is None:
        return None
    elements = _list(given, who)
    if len(elements) not in (2, 3):
        raise _wrong(who, given, "a list of two or three numbers")
    for element in elements:
        if isinstance(element, bool) or not isinstance(element, int | float):
            raise _wrong(who, given, "a list of two or three numbers")
        _number(element, who)
    return list(elements)


def _scalars(data: Mapping[str, object], keys: Sequence[str], who: str) -> Shape:
    """Return the scalars under these keys: numbers, texts, booleans."""
    found: Shape = {}
    for key in keys:
        value = data.get(key)
        if value is None:
            continue
        where = f"{who}: {quoted(key)}"
        if isinstance(value, str):
            _text(value, where)
        elif not isinstance(value, bool):
            _number(value, where)
        found[key] = value
    return found


def _number(value: object, where: str) -> None:
    if not isinstance(value, int | float):
        raise _wrong(where, value, "a number or a text")
    if isinstance(value, float) and not isfinite(value):
        raise _wrong(where, value, "a finite number")
    if abs(value) > LARGEST:
        raise BadInput(f"{where} is too large a number")


def _text(value: object, where: str) -> str:
    if not isinstance(value, str):
        raise _wrong(where, value, "a text")
    if len(value) > LONGEST_TEXT:
        raise BadInput(f"{where} is longer than {LONGEST_TEXT} characters")
    if any("\ud800" <= character <= "\udfff" for character in value):
        raise BadInput(f"{where} holds half a character: it is no text")
    return value


def _key(data: Mapping[str, object], who: str) -> str:
    value = _given(data, "key", who)
    if not isinstance(value, str) or KEY.fullmatch(value) is None:
        raise _wrong(f"{who}: key", value, "8 to 32 letters, digits, - and _")
    return value


def _given(data: Mapping[str, object], key: str, who: str) -> object:
    if key not in data:
        raise BadInput(f"{who} has no {key}")
    return data[key]


def _table(given: object, who: str, keys: Sequence[str]) -> dict[str, object]:
    data = _object(given, who)
    for key in data:
        if key not in keys:
            raise BadInput(f"{who} has an unknown key {quoted(key)}; it may have: {listed(keys)}")
    return data


def _object(given: object, who: str) -> dict[str, object]:
    if not isinstance(given, dict):
        raise _wrong(who, given, "an object")
    return given


def _list(given: object, who: str) -> list[object]:
    if not isinstance(given, list):
        raise _wrong(who, given, "a list")
    return given


def _wrong(where: str, value: object, wanted: str) -> BadInput:
    return BadInput(f"{where} {shown(value)} is not {wanted}")


def _too_many(what: str, most: int) -> BadInput:
    return BadInput(f"a plan has at most {most} {what}")
