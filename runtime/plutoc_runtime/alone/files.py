"""The two files that a user writes: the fleet, with its map and its world, and the missions."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from math import dist
from typing import TYPE_CHECKING, Any

from ..domain.actions import PICK, RELEASE
from ..domain.airspace import Airspace
from ..domain.errors import BadInput
from ..domain.fields import Entity, time_of_day
from ..domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from ..domain.geometry import covers_ground
from ..domain.model import AfterTrip, Item
from ..domain.quantities import QUANTITIES, Type, number_from
from ..domain.text import cut_off, number, quoted, shown
from ..fleet.reach import wrong_aboard

if TYPE_CHECKING:
    from pathlib import Path

    from ..domain.app import App
    from ..domain.geometry import Corner
    from ..domain.model import Mission, Point, Trip

HOME_SIZE = 0.1
"""The diameter of a drone on the ground, in metres."""

_Read = Callable[[Any], Any]
"""Converts a value; raises a `ValueError` whose text continues after the key and the value."""


def load_fleet(path: Path, app: App) -> FleetData:
    """Return a fleet file's data, without what only real flights need."""
    schema = "map:table? fleet:table? drone:tables world:table? navigation:any? localization:any?"
    top = _table(_read_toml(path), f"{path}", schema)
    schema = "size:size? image:any? cruise_height:height? ceiling:height? no_fly:areas?"
    area, plain = _table(top.get("map", {}), f"{path}: map", schema), Airspace()
    cruise = area.get("cruise_height", plain.cruise_height)
    ceiling = area.setdefault("ceiling", max(plain.ceiling, cruise))
    if cruise > ceiling:
        raise BadInput(f"{path}: map: cruise_height is above the ceiling, {number(ceiling)} m")
    airspace = Airspace(**area)
    schema = "after_trip:after? max_airborne:count? apart:any? navigation:any? localization:any?"
    return FleetData(
        airspace=airspace,
        **_table(top.get("fleet", {}), f"{path}: fleet", schema),
        drones=_drones(top["drone"], f"{path}: drone", app, airspace),
        world=_world(top["world"], f"{path}: world") if "world" in top else None,
    )


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file, each of the app's own class."""
    missions, evaluator = list[Any](), _one_of(app.evaluators)
    schema = f"name:name? trip:tables {_fields(app, Entity.MISSION)}"
    for index, entry in enumerate(_table(_read_toml(path), f"{path}", "mission:tables")["mission"]):
        name = entry.get("name") if isinstance(entry, dict) else None
        who = f"{path}: mission {quoted(name) if isinstance(name, str) else index + 1}"
        given = {"name": f"{index + 1}", **_table(entry, who, schema, EVALUATOR=evaluator)}
        trips = _trips(given.pop("trip"), f"{who}, trip", app, airspace)
        missions.append(app.mission(index=index, trips=trips, **given))
    _differ(f"{path}: mission", (mission.name for mission in missions))
    return missions


def _table(data: object, who: str, schema: str, **kinds: _Read) -> dict[str, Any]:
    """Return the values of a table: `key:kind` for each, with `?` if it may be missing."""
    if not isinstance(data, dict):
        raise BadInput(f"{who}: is not a table")
    values, keys = dict[str, Any](), dict(one.split(":") for one in schema.split())
    for key in data:
        if key not in keys:
            raise BadInput(f"{who}: unknown key {quoted(key)}; there may be {', '.join(keys)}")
    for key, kind in keys.items():
        if key in data and kind != "any?":
            try:
                values[key] = {**_KINDS, **kinds}[kind.rstrip("?")](data[key])
            except ValueError as error:
                raise BadInput(f"{who}: {key} {cut_off(shown(data[key]), 60)} {error}") from None
        elif not kind.endswith("?"):
            raise BadInput(f"{who}: has no {key}")
    return values


def _differ(who: str, names: Iterable[str]) -> None:
    for name, count in Counter(names).most_common(1):
        if count > 1:
            raise BadInput(f"{who} {quoted(name)}: there are {count} of them: names must differ")


def _drones(entries: list[Any], who: str, app: App, airspace: Airspace) -> list[DroneData]:
    names = [category.name for category in app.categories]
    only = {"category": names[0]} if len(names) == 1 else {}  # the only category is the default
    schema = f"id:name category:category{'?' if only else ''} home:point uri:any? navigation:any?"
    kinds = {"category": _one_of(names), "point": _point(airspace, 0.0)}
    drones = [
        DroneData(**only | _table(entry, f"{who} {place}", f"{schema} options:any?", **kinds))
        for place, entry in enumerate(entries, 1)
    ]
    _differ(who, (drone.id for drone in drones))
    if (found := _first_crowded([drone.home for drone in drones], HOME_SIZE)) is not None:
        raise BadInput(f"{who} {found + 1}: home is where another drone has its own")
    return drones


def _world(data: object, who: str) -> WorldData:
    top = _table(data, who, "background:levels? feature:list? source:list?")
    schema = "kind:name at:corner radius:radius?"
    features = [Feature(**_table(one, f"{who}.feature", schema)) for one in top.get("feature", [])]
    schema = "quantity:name at:corner peak:float radius:radius"
    sources = [Source(**_table(one, f"{who}.source", schema)) for one in top.get("source", [])]
    background = top.get("background", {})
    return WorldData(features=tuple(features), sources=tuple(sources), background=background)


def _trips(entries: list[Any], who: str, app: App, airspace: Airspace) -> list[Trip]:
    schema = "name:name? action:action target:point source:point? parameters:table? item:table?"
    schema = f"{schema} {_fields(app, Entity.TRIP)}"
    kinds = {"action": _one_of(app.actions), "EVALUATOR": _one_of(app.evaluators)}
    kinds["point"] = _point(airspace, airspace.cruise_height)
    trips: list[Trip] = []
    for index, entry in enumerate(entries):
        called = f"{who} {index + 1}"
        given = {"name": f"{index + 1}", **_table(entry, called, schema, **kinds)}
        action, item = app.actions[given["action"]], given.pop("item", None)
        known = action.parameters
        keys = [f"{one.name}:{one.type.value}{'?' * (one.default is not None)}" for one in known]
        filled: dict[str, Any] = {one.name: one.default for one in known}
        filled |= _table(given.get("parameters", {}), f"{called}, parameters", " ".join(keys))
        if (item is None) == (action.name in (PICK, RELEASE)):
            raise BadInput(
                f"{called}: {action.name} {'takes no' if item is not None else 'needs an'} item"
            )
        if item is not None:
            item = Item(**_table(item, f"{called}, item", "name:name mass:weight"))
        given |= {"parameters": filled, "item": item, "index": index}
        trips.append(app.trip(**given))
    _differ(who, (trip.name for trip in trips))
    if wrong := wrong_aboard(trips):
        raise BadInput(f"{who} {wrong[0] + 1}: {wrong[1]}")
    return trips


def _fields(app: App, entity: Entity) -> str:
    return " ".join(f"{one.name}:{one.type.name}?" for one in app.fields if one.on is entity)


def _point(airspace: Airspace, height: float) -> _Read:
    def read(value: object) -> Point:
        x, y, *z = _lengths(value, (2, 3), -1e5, 1e5)
        point = x, y, z[0] if z else height
        if problem := airspace.problem(point):
            raise ValueError(f"is no place for a drone: {problem}")
        return point

    return read


def _lengths(value: object, counts: Sequence[int], least: float, most: float) -> list[float]:
    if not isinstance(value, list) or len(value) not in counts:
        raise ValueError(f"is not a list of {' or '.join(map(str, counts))} numbers")
    return [number_from(Type.LENGTH, least, most)(one) for one in value]


def _areas(value: list[Any]) -> tuple[tuple[Corner, ...], ...]:
    areas = [[*map(_KINDS["corner"], _KINDS["tables"](one))] for one in _KINDS["list"](value)]
    if not all(map(covers_ground, areas)):
        raise ValueError("has an area that covers no ground")
    return tuple(map(tuple, areas))


def _is(what: str, test: Callable[[Any], object]) -> _Read:
    def read(value: object) -> object:
        if not test(value):
            raise ValueError(f"is not {what}")
        return value

    return read


def _one_of(words: Iterable[str]) -> _Read:
    return _is(f"one of: {', '.join(words)}", [*words].__contains__)


def _whole(least: float) -> _Read:
    return _is(f"a whole number from {least:.0f}", lambda v: type(v) is int and least <= v <= 1e9)


_REAL = number_from(Type.FLOAT)
_KINDS: dict[str, _Read] = {
    **{kind.value: number_from(kind) for kind in (*QUANTITIES, Type.FLOAT)},
    "text": _is("a text in quotes", lambda value: isinstance(value, str)),
    "bool": _is("true or false", lambda value: isinstance(value, bool)),
    "int": _whole(-1e9),
    "INT": _whole(-1e9),
    "ROUNDS": lambda value: value is True or _whole(0)(value),
    "TIME": number_from(Type.TIME, 0.001, or_none=True),
    "TIME_OF_DAY": time_of_day,
    "name": _is(
        "a name: 1 to 200 characters that can be seen, and no blanks around them",
        lambda v: isinstance(v, str) and v.isprintable() and 0 < len(v.strip()) == len(v) <= 200,
    ),
    "list": _is("a list", lambda value: isinstance(value, list)),
    "table": _is("a table", lambda value: isinstance(value, dict)),
    "tables": _is("a list with something in it", lambda value: isinstance(value, list) and value),
    "levels": lambda value: {one: _REAL(of) for one, of in _KINDS["table"](value).items()},
    "corner": lambda value: tuple(_lengths(value, (2,), -1e5, 1e5)),
    "size": lambda value: tuple(_lengths(value, (2,), 0.1, 1e4)),
    "areas": _areas,
    "height": number_from(Type.LENGTH, 0.1, 1000.0),
    "radius": number_from(Type.LENGTH, 0.01, 1e5),
    "weight": number_from(Type.MASS, 0.0, 1000.0),
    "count": _whole(1),
    "after": lambda value: AfterTrip(_one_of([one.value for one in AfterTrip])(value)),
}


def _first_crowded(places: Sequence[Point], apart: float) -> int | None:
    """Return the index of the first point too near to an earlier one, or None."""
    cells: dict[tuple[int, int], list[Point]] = {}
    for index, place in enumerate(places):
        x, y = int(place[0] // apart), int(place[1] // apart)
        around = [cells.get((x + i, y + j), []) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        if any(dist(place, other) < apart for others in around for other in others):
            return index
        cells.setdefault((x, y), []).append(place)
    return None


_LARGEST = 1 << 20
"""Bytes. A plan is written by people: anything larger is another file."""

_LONG_KEY = re.compile(r"""(?<![\w"'-])(?:[\w"'-]+[ \t]*\.[ \t]*){100}""")
"""For each part of such a key `tomllib` copies all before it."""


def _read_toml(path: Path) -> dict[str, Any]:
    """Parse a plan file; raise `BadInput` if it is not TOML of a sane size."""
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
        text = content.decode("utf-8-sig")
        if len(content) > _LARGEST or _LONG_KEY.search(text):
            raise ValueError("it is larger than 1 MiB, or nested too deep")
        return tomllib.loads(text)
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:
        raise BadInput(f"{path}: is no plan file: {error}") from None
