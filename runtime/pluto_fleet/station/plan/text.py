"""Converting a plan to a missions file, and back: complete, or as a page has drawn it so far."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from datetime import time
from itertools import chain, count
from typing import TYPE_CHECKING, Any

from ...files.landmarks import NO_LANDMARKS
from ...files.missions import KEYS, missions_of
from ...files.reading import parsed
from ...files.toml import toml_value
from ...files.writing import mission_table, trip_table
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity
from ...shared.domain.values import point
from .problems import as_in_a_file
from .shape import TRIP_KEYS, Shape, fields_of

if TYPE_CHECKING:
    from pathlib import Path

    from ...app import App
    from ...files.landmarks import Landmarks
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Trip


NAME = "missions.toml"
"""The name of a file in messages, if its sender gives none."""

_BASIC = ("name", "action", "item", "parameters", "source", "target")


def text_of(app: App, missions: Sequence[Shape]) -> str:
    """Return the missions file of these missions, complete or not."""
    return "\n".join(line for mission in missions for line in _mission(app, mission))


def shapes_of(
    text: str,
    app: App,
    airspace: Airspace,
    landmarks: Landmarks,
    file: str = NAME,
    folder: Path | None = None,
) -> list[Shape]:
    """Return the missions of a file, without keys, areas and lists as plain trips and missions.

    `landmarks` are the places and zones that it may name. `folder`: where it lies, and its lists beside it. Raises `BadInput` as `check` does.
    """
    document = parsed(file, text)
    document.folder, document.landmarks = folder, landmarks
    missions = missions_of(document, app, airspace)
    tables: Any = [
        _sparse(mission_table(app, mission), app) if given is None or "area" in given else given
        for mission, given in zip(missions, document.given, strict=True)
    ]
    return [_shape(mission, str(i), app, landmarks) for i, mission in enumerate(tables, 1)]


def renamed(missions: Sequence[Shape], taken: Collection[str]) -> list[Shape]:
    """Return missions under names that are not taken, such as "North field 2", by which others come after them."""
    names, new = {*taken}, dict[str, str]()
    for mission in missions:
        name = mission["name"]
        counted = (f"{name} {number}" for number in count(2))
        new[name] = next(one for one in chain([name], counted) if one not in names)
        names.add(new[name])
    return [_with_names(mission, new) for mission in missions]


def _with_names(mission: Shape, new: Mapping[str, str]) -> Shape:
    found = {**mission, "name": new[mission["name"]]}
    match mission.get("after"):
        case list(after):
            found["after"] = [new.get(str(name), name) for name in after]
    return found


def trip_shape(app: App, trip: Trip) -> Shape:
    """Return a trip as pages have it, without a key."""
    return _trip(_unusual(trip_table(app, trip), app, Entity.TRIP), app, NO_LANDMARKS)


def _sparse(table: dict[str, Any], app: App) -> dict[str, Any]:
    """Return a mission that a list or an area has made without what only says a default again."""
    trips = [_unusual(trip, app, Entity.TRIP) for trip in table["trip"]]
    return {**_unusual(table, app, Entity.MISSION), "trip": trips}


def _unusual(table: dict[str, Any], app: App, entity: Entity) -> dict[str, Any]:
    usual = {one.name: one.default for one in app.fields if one.on is entity}
    return {key: one for key, one in table.items() if key not in usual or one != usual[key]}


def _mission(app: App, mission: Shape) -> Iterator[str]:
    given = as_in_a_file(mission)
    yield "[[mission]]"
    yield from _pairs(given, ("name", *KEYS, *fields_of(app, Entity.MISSION)), "")
    yield ""
    for trip in given["trip"]:
        yield "  [[mission.trip]]"
        yield from _pairs(trip, (*_BASIC, *fields_of(app, Entity.TRIP)), "  ")
        yield ""


def _pairs(given: Mapping[str, object], keys: Sequence[str], indent: str) -> Iterator[str]:
    for key in keys:
        if key in given:
            yield f"{indent}{key} = {toml_value(given[key])}"


def _shape(given: Mapping[str, Any], number: str, app: App, landmarks: Landmarks) -> Shape:
    return {
        "name": given.get("name", number),
        **_promises(given),
        **_fields(given, app, Entity.MISSION),
        "trips": [_trip(trip, app, landmarks) for trip in given["trip"]],
    }


def _promises(given: Mapping[str, Any]) -> Shape:
    opens, deadline = given.get("window", (None, given.get("deadline")))
    after = given.get("after", [])
    found = {"opens": opens, "deadline": deadline}
    shape = {key: _plain(value) for key, value in found.items() if value is not None}
    return {
        **shape,
        **({"after": [after] if isinstance(after, str) else [*after]} if after else {}),
    }


def _trip(given: Mapping[str, Any], app: App, landmarks: Landmarks) -> Shape:
    given = _apart(given)
    trip = {key: given[key] for key in _BASIC if key in given}
    for key in ("target", "source"):
        if trip.get(key) is not None:
            trip[key] = _metres(trip[key], landmarks)
    return {**trip, **_fields(given, app, Entity.TRIP)}


def _apart(trip: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a trip of a file with what its target follows, if that moves, as fields of its own."""
    target = trip.get("target")
    if not isinstance(target, dict):
        return trip
    return {**trip, **target, "target": None}


def _fields(given: Mapping[str, Any], app: App, entity: Entity) -> Shape:
    fields = [key for key in fields_of(app, entity) if key in given]
    return {key: _plain(given[key]) for key in fields}


def _plain(given: object) -> object:
    """Return a value as JSON, with TOML's times of day as text."""
    return given.isoformat("auto") if isinstance(given, time) else given


def _metres(place: Sequence[object] | str, landmarks: Landmarks) -> list[object]:
    """Return a point in metres: files may have "80 cm", or the name of a place."""
    if isinstance(place, str):
        return [*landmarks.place[place]]
    read = point(place)
    return [
        metres if isinstance(given, str) else given
        for given, metres in zip(place, read, strict=True)
    ]


def unfinished_shapes(text: str, app: App, file: str) -> list[Shape]:
    """Return the missions of a text, without keys; raise `BadInput` if no page can have drawn them.

    What they hold is checked when they are taken into a plan.
    """
    data = parsed(file, text).data
    missions = data.get("mission", [])
    if data.keys() - {"mission"} or not isinstance(missions, list):
        raise BadInput(f"{file}: is no plan")
    return [_unfinished(one, number, app, file) for number, one in enumerate(missions, 1)]


def _unfinished(given: Any, number: int, app: App, file: str) -> Shape:
    trips = given.get("trip", []) if isinstance(given, dict) else None
    if not isinstance(trips, list) or not all(isinstance(one, dict) for one in trips):
        raise BadInput(f"{file}: mission {number} is none")
    rest = {key: _plain(value) for key, value in given.items() if key != "trip"}
    match rest.pop("window", None):
        case [opens, deadline]:
            rest |= {"opens": opens, "deadline": deadline}
    if isinstance(rest.get("after"), str):
        rest["after"] = [rest["after"]]
    keys = (*TRIP_KEYS, *fields_of(app, Entity.TRIP))
    drawn = [{key: _plain(one[key]) for key in keys if key in one} for one in map(_apart, trips)]
    return {"name": str(number), **rest, "trips": drawn}
