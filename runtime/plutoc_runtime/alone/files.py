"""The two files that a user writes: the fleet, with its map and its world, and the missions.

The first mistake is told, as the library tells it, which tells all of them, each with its line.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING, Any

from ..domain import values
from ..domain.actions import PICK, RELEASE
from ..domain.airspace import Airspace
from ..domain.errors import BadInput
from ..domain.fields import Entity
from ..domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from ..domain.model import NOTHING, Item, Trip
from ..domain.plan_rules import Cells, crowded, wrongly_carried
from ..domain.text import number, quoted
from ..domain.values import Read
from .toml import parsed, text_of

if TYPE_CHECKING:
    from pathlib import Path

    from ..domain.actions import Action
    from ..domain.app import App
    from ..domain.model import Mission, Point

_KINDS: dict[str, Read] = {
    **{kind.value: read for kind, read in values.PARAMETER.items()},
    **{kind.name: read for kind, read in values.FIELD.items()},
    "name": values.name,
    "size": values.size,
    "height": values.HEIGHT,
    "areas": values.areas,
    "after": values.after_trip,
    "count": values.count,
    "corner": values.corner,
    "radius": values.RADIUS,
    "weight": values.MASS,
}


class _Whole(ValueError):
    """A message that does not continue after the key and its value."""


def load_fleet(path: Path, app: App) -> FleetData:
    """Return a fleet file's data, without what only real flights need."""
    schema = "map:any? fleet:any? drone:any? navigation:any? localization:any? world:any?"
    top = parsed(path, text_of(path))
    _table(top, f"{path}", schema)
    airspace = _airspace(top.get("map", {}), f"{path}: map")
    schema = "after_trip:after? apart:any? max_airborne:count? navigation:any? localization:any?"
    return FleetData(
        airspace=airspace,
        **_table(top.get("fleet", {}), f"{path}: fleet", schema),
        drones=[*_drones(top, f"{path}", app, airspace)],
        world=_world(top["world"], f"{path}: world") if "world" in top else None,
    )


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file, each of the app's own class."""
    top, missions = parsed(path, text_of(path)), list[Any]()
    _table(top, f"{path}", "mission:any?")
    schema = f"name:new trip:any? {_fields(app, Entity.MISSION)}"
    kinds = {"new": _new("mission"), "EVALUATOR": _one_of("evaluator", app.evaluators)}
    for index, entry in enumerate(_tables(top, f"{path}", "mission", needed=True)):
        name = entry.get("name")
        who = f"{path}: mission {quoted(name) if isinstance(name, str) else index + 1}"
        given = _table({"name": f"{index + 1}", **entry}, who, schema, **kinds)
        trips = _trips(entry, who, app, airspace)
        missions.append(app.mission(**given, index=index, trips=trips))
    return missions


def _table(
    data: object,
    who: str,
    schema: str,
    lacks: str = "has no",
    called: str = "key",
    /,
    **kinds: Read,
) -> dict[str, Any]:
    """Return the values of a table: `key:kind` for each, with `?` if it may be missing.

    What is of no known kind is read elsewhere, or for real drones only.
    """
    found, keys = dict[str, Any](), dict(one.split(":") for one in schema.split())
    if not isinstance(data, dict):
        raise BadInput(f"{who} is not a table: write [{who.rpartition(' ')[2]}]")
    for key in data:
        if key not in keys:
            there_are = ", ".join(keys) or "none"
            raise BadInput(f"{who}: unknown {called} {quoted(key)}; there may be: {there_are}")
    for key, kind in keys.items():
        if key not in data and not kind.endswith("?"):
            raise BadInput(f"{who}: {lacks} {key}")
        read = {**_KINDS, **kinds}.get(kind.rstrip("?"))
        if key in data and read:
            found[key] = _read(data, who, key, read)
    return found


def _read(table: dict[str, Any], who: str, key: str, read: Read) -> Any:
    try:
        return read(table[key])
    except _Whole as error:
        raise BadInput(f"{who}: {error}") from None
    except ValueError as error:
        raise BadInput(f"{who}: {key} {values.shown(table[key])} {error}") from None


def _tables(table: dict[str, Any], who: str, header: str, *, needed: bool = False) -> list[Any]:
    """Return a list of tables, such as [[mission.trip]]."""
    key = header.rpartition(".")[2]
    given = table.get(key, [])
    if not isinstance(given, list) or not all(isinstance(one, dict) for one in given):
        said = f"is not a list of tables: write [[{header}]], with two brackets"
        raise BadInput(f"{who}: {key} {said}")
    if needed and not given:
        raise BadInput(f"{who}: has no [[{header}]]")
    return given


def _airspace(data: object, who: str) -> Airspace:
    schema = "size:size? image:any? cruise_height:height? ceiling:height? no_fly:areas?"
    given, plain = _table(data, who, schema), Airspace()
    areas = list[Any]()
    for place, area in enumerate(given.get("no_fly", ()), 1):
        try:
            areas.append(values.area(area))
        except ValueError as error:
            raise BadInput(f"{who}: no_fly area {place} {error}") from None
    cruise = given.get("cruise_height", plain.cruise_height)
    ceiling = given.setdefault("ceiling", max(plain.ceiling, cruise))
    if cruise > ceiling:
        above = f"is above the ceiling, {number(ceiling)} m"
        raise BadInput(f"{who}: cruise_height, {number(cruise)} m, {above}")
    return Airspace(**{**given, "no_fly": tuple(areas)})


def _drones(top: dict[str, Any], path: str, app: App, airspace: Airspace) -> Iterator[DroneData]:
    homes, names = Cells(), [category.name for category in app.categories]
    schema = "id:new category:category? home:home uri:any? navigation:any? options:any?"
    if len(names) > 1:  # the only one is the default
        schema = schema.replace("?", "", 1)
    kinds = {"category": _one_of("category", names), "home": _point("home", airspace, 0.0)}
    kinds["new"] = _new("drone")
    for place, entry in enumerate(_tables(top, path, "drone", needed=True), 1):
        who = f"{path}: drone {place}"
        drone = DroneData(**{"category": names[0], **_table(entry, who, schema, **kinds)})
        if said := crowded(drone.home, drone.id, homes):
            raise BadInput(f"{who}: {said}")
        yield drone


def _world(data: object, who: str) -> WorldData:
    table: Any = data
    _table(data, who, "background:any? feature:any? source:any?")
    schema = "kind:name at:corner radius:radius?"
    features = [
        Feature(**_table(one, f"{who}.feature", schema))
        for one in _tables(table, who, "world.feature")
    ]
    schema = "quantity:name at:corner peak:float radius:radius"
    sources = [
        Source(**_table(one, f"{who}.source", schema))
        for one in _tables(table, who, "world.source")
    ]
    background = table.get("background", {})
    if not isinstance(background, dict):
        _table(background, f"{who}, background", "")
    levels = {key: _read(background, who, key, values.real) for key in background}
    return WorldData(features=tuple(features), sources=tuple(sources), background=levels)


def _trips(mission: dict[str, Any], who: str, app: App, airspace: Airspace) -> list[Trip]:
    schema = "name:new action:action target:target source:source? parameters:any? item:any?"
    schema = f"{schema} {_fields(app, Entity.TRIP)}"
    kinds = {key: _point(key, airspace, airspace.cruise_height) for key in ("target", "source")}
    kinds["action"] = _one_of("action", app.actions)
    kinds |= {"EVALUATOR": _one_of("evaluator", app.evaluators), "new": _new("trip")}
    trips = list[Trip]()
    for index, entry in enumerate(_tables(mission, who, "mission.trip", needed=True)):
        called = f"{who}, trip {index + 1}"
        given = _table({"name": f"{index + 1}", **entry}, called, schema, **kinds)
        action = app.actions[given["action"]]
        given["parameters"] = _parameters(entry.get("parameters", {}), called, action) or NOTHING
        trips.append(
            app.trip(**given, index=index, item=_item(entry.get("item"), called, action.name))
        )
    for index, said in wrongly_carried(trips):
        raise BadInput(f"{who}, trip {index + 1}: {said}")
    return trips


def _parameters(data: object, who: str, action: Action) -> dict[str, Any]:
    known = action.parameters
    schema = " ".join(
        f"{one.name}:{one.type.value}{'?' * (one.default is not None)}" for one in known
    )
    if isinstance(data, dict) and data and not known:
        there_is = f"{action.name} has no parameters, and {quoted(next(iter(data)))} is given"
        raise BadInput(f"{who}, parameters: {there_is}")
    lacks = f"{action.name} needs the parameter"
    given = _table(data, f"{who}, parameters", schema, lacks, "parameter")
    return {**{one.name: one.default for one in known}, **given}


def _item(data: object, who: str, action: str) -> Item | None:
    if data is None and action not in (PICK, RELEASE):
        return None
    if data is None:
        example = 'item = { name = "pills", mass = "4 g" }'
        raise BadInput(f"{who}: {action} needs an item, such as {example}")
    if isinstance(data, dict) and action not in (PICK, RELEASE):
        raise BadInput(f"{who}: {action} takes no item: only {PICK} and {RELEASE} do")
    return Item(**_table(data, f"{who}, item", "name:name mass:weight"))


def _fields(app: App, entity: Entity) -> str:
    return " ".join(f"{one.name}:{one.type.name}?" for one in app.fields if one.on is entity)


def _point(key: str, airspace: Airspace, height: float) -> Read:
    def read(value: object) -> Point:
        x, y, *z = values.point(value)
        point = x, y, z[0] if z else height
        if problem := airspace.problem(point):
            raise _Whole(f"{key} {problem}")
        return point

    return read


def _one_of(what: str, names: Collection[str]) -> Read:
    read = values.name if what == "evaluator" else values.text

    def read_one(value: object) -> object:
        if read(value) not in names:
            there_is = ", ".join(names) or "none"
            raise _Whole(f"unknown {what} {quoted(f'{value}')}; this app has: {there_is}")
        return value

    return read_one


def _new(what: str) -> Read:
    """Return a reader of names that must differ."""
    names = set[str]()

    def read(value: object) -> str:
        name: str = values.name(value)
        if name in names:
            raise _Whole(f"there is another {what} {quoted(name)}: names must differ")
        names.add(name)
        return name

    return read
