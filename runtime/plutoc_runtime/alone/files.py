"""The two files that a user writes: the fleet, with its map and its world, and the missions.

The first mistake is told, as the library tells it, which tells all of them, each with its line.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Collection, Iterator
from typing import TYPE_CHECKING, Any

from ..domain import values
from ..domain.actions import PICK, RELEASE
from ..domain.airspace import Airspace
from ..domain.app import needs_library
from ..domain.errors import BadInput
from ..domain.fields import Entity, FieldType
from ..domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from ..domain.model import Item
from ..domain.motion import motion_of
from ..domain.text import cut_off, number, printable, quoted
from ..domain.values import Cells, crowded, wrongly_carried

if TYPE_CHECKING:
    from pathlib import Path

    from ..domain.actions import Action
    from ..domain.app import App
    from ..domain.model import Mission, Point, Trip
    from ..domain.values import Read

LARGEST = 1 << 20  # bytes: a plan is written by people, and anything larger is another file
MOST = 100  # parts of one key: `tomllib` copies for each all before it; a plan's have two

_PART = r"""(?:[A-Za-z0-9_-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_NEXT = rf"(?:[ \t]*\.[ \t]*{_PART})"
_KEY = re.compile(rf"{_PART}({_NEXT}{{{MOST}}})?{_NEXT}*+")
_LONG = re.compile(r"(?<![.\w])\d[\d_]{600}")  # a number that Python may refuse to read
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")

_REAL = "navigation:any? localization:any?"  # what only real flights need
_REACHED = "uri:any? navigation:any? options:any? parameters:any?"  # and of one drone
_SHOWN = "image:any? north:any? places:any? zones:any?"  # what only the library shows
# Keys of a mission that the library reads, and what it needs for them.
_LIBRARY = {"deadline": "", "window": "", "after": "", "each": "", "area": "[areas]"}

USUAL = "texts, and numbers with a unit, stand in quotes, lists in [ ], and each key stands once"
_UNREADABLE: dict[type[Exception], str] = {
    FileNotFoundError: "there is no such file",
    IsADirectoryError: "is a folder, not a file",
    PermissionError: "may not be read: its permissions forbid it",
    ValueError: "is not a file name",  # a NUL in it
}


def load_fleet(path: Path, app: App) -> FleetData:
    """Return a fleet file's data, without what only real flights need."""
    top, who = parsed(path, text_of(path)), f"{path}"
    _table(top, who, f"map:any? fleet:any? motion:any? drone:any? world:any? {_REAL}")
    keys = " ".join(f"{key}:{key}?" for key in values.MOTION)
    airspace = _airspace(top.get("map", {}), f"{who}: map")
    schema = f"apart:any? after_trip:after_trip? max_airborne:count? silence:any? {_REAL}"
    schema += " charges_at_home:boolean?"
    return FleetData(
        airspace=airspace,
        **_table(top.get("fleet", {}), f"{who}: fleet", schema),
        motion=motion_of(_table(top.get("motion", {}), f"{who}: motion", keys, **values.MOTION)),
        drones=[*_drones(top, who, app, airspace)],
        world=_world(top["world"], f"{who}: world") if "world" in top else None,
    )


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file, each of the app's own class."""
    top, missions = parsed(path, text_of(path)), list[Any]()
    _table(top, f"{path}", "mission:any?")
    schema, kinds, hints = _fields(app, Entity.MISSION, "name:new trip:any?")
    kinds["new"] = values.new_name("mission")
    for index, entry in enumerate(_tables(top, f"{path}", "mission", needed=True)):
        name = entry.get("name")
        who = f"{path}: mission {quoted(name) if isinstance(name, str) else index + 1}"
        if key := next(filter(entry.__contains__, _LIBRARY), ""):
            raise BadInput(f"{who}: {needs_library(key, _LIBRARY[key])}")
        given = _table({"name": f"{index + 1}", **entry}, who, schema, hints, **kinds)
        trips = _trips(entry, who, app, airspace)
        missions.append(app.mission(**given, index=index, trips=trips))
    return missions


def _table(data: Any, who: str, schema: str, hints: Any = None, /, **kinds: Read) -> dict[str, Any]:
    """Return the values of a table: `key:kind` for each, with `?` if it may be missing, else a hint.

    A kind is one of these, or a reader in `values`; any other is read elsewhere, or never.
    """
    found, keys = dict[str, Any](), dict(one.split(":") for one in schema.split())
    if not isinstance(data, dict):
        raise BadInput(f"{who} is not a table: write [{who.rpartition(' ')[2]}]")
    for key in data:
        if key not in keys:
            there_are = ", ".join(keys) or "none"
            raise BadInput(f"{who}: unknown key {quoted(key)}; there may be: {there_are}")
    for key, kind in keys.items():
        if key not in data and not kind.endswith("?"):
            raise BadInput(f"{who}: has no {key}{(hints or {}).get(key, '')}")
        name = kind.rstrip("?")
        if key in data and (read := kinds.get(name) or getattr(values, name, None)):
            found[key] = _read(data, who, key, read)
    return found


def _read(table: dict[str, Any], who: str, key: str, read: Read) -> Any:
    try:
        return read(table[key])
    except BadInput as error:  # it says itself what it is about
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


def _airspace(data: Any, who: str) -> Airspace:
    plain, areas = Airspace(), list[Any]()
    schema = f"size:size? cruise_height:HEIGHT? ceiling:HEIGHT? no_fly:areas? {_SHOWN}"
    given = _table(data, who, schema)
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
    kinds = {"category": _one_of("category", names), "home": _point("home", airspace, 0.0)}
    kinds["new"] = values.new_name("drone")
    optional = "?" * (len(names) == 1)  # the only category is the default
    schema = f"id:new category:category{optional} home:home {_REACHED}"
    for place, entry in enumerate(_tables(top, path, "drone", needed=True), 1):
        who = f"{path}: drone {place}"
        drone = DroneData(**{"category": names[0], **_table(entry, who, schema, **kinds)})
        if said := crowded(drone.home, drone.id, homes):
            raise BadInput(f"{who}: {said}")
        yield drone


def _world(data: Any, who: str) -> WorldData:
    _table(data, who, "background:any? feature:any? source:any?")
    seen, measured = _tables(data, who, "world.feature"), _tables(data, who, "world.source")
    schema = "kind:name at:corner radius:RADIUS?"
    features = tuple(Feature(**_table(one, f"{who}.feature", schema)) for one in seen)
    schema = "quantity:name at:corner peak:real radius:RADIUS"
    sources = tuple(Source(**_table(one, f"{who}.source", schema)) for one in measured)
    background = data.get("background", {})
    if not isinstance(background, dict):
        _table(background, f"{who}, background", "")
    levels = {key: _read(background, who, key, values.real) for key in background}
    return WorldData(features=features, sources=sources, background=levels)


def _trips(mission: dict[str, Any], who: str, app: App, airspace: Airspace) -> list[Trip]:
    trips, schema = list[Any](), "name:new action:action target:target source:source?"
    schema, kinds, hints = _fields(app, Entity.TRIP, f"{schema} parameters:any? item:any?")
    kinds |= {key: _point(key, airspace, airspace.cruise_height) for key in ("target", "source")}
    kinds |= {"new": values.new_name("trip"), "action": _one_of("action", app.actions)}
    for index, entry in enumerate(_tables(mission, who, "mission.trip", needed=True)):
        called, data = f"{who}, trip {index + 1}", {"name": f"{index + 1}", **entry}
        given = _table(data, called, schema, hints, **kinds)
        action = app.actions[given["action"]]
        given["parameters"] = _parameters(entry.get("parameters", {}), called, action)
        given["item"] = _item(entry.get("item"), called, action.name)
        trips.append(app.trip(**given, index=index))
    for index, said in wrongly_carried(trips):
        raise BadInput(f"{who}, trip {index + 1}: {said}")
    return trips


def _parameters(data: Any, who: str, action: Action) -> dict[str, Any]:
    if not isinstance(data, dict):
        raise BadInput(f"{who}, parameters is not a table: write [parameters]")
    try:
        return values.parameters(action, data)
    except ValueError as error:
        raise BadInput(f"{who}, parameters: {error}") from None


def _item(data: Any, who: str, action: str) -> Item | None:
    carries = action in (PICK, RELEASE)
    if data is None and carries:
        example = 'item = { name = "pills", mass = "4 g" }'
        raise BadInput(f"{who}: {action} needs an item, such as {example}")
    if isinstance(data, dict) and not carries:
        raise BadInput(f"{who}: {action} takes no item: only {PICK} and {RELEASE} do")
    given = None if data is None else _table(data, f"{who}, item", "name:name mass:MASS")
    return Item(**given) if given else None


def _fields(app: App, on: Entity, schema: str) -> tuple[str, dict[str, Read], dict[str, str]]:
    """Return a schema with the app's fields, how they are read, and what to write where needed."""
    evaluator = _one_of("evaluator", app.evaluators, values.name)
    readers = {**values.FIELD, FieldType.EVALUATOR: evaluator}
    kinds = {one.name: readers[one.type] for one in app.fields if one.on is on}
    hints = {one.name: one.hint for one in app.fields if one.on is on}
    fields = (f"{name}:{name}{'' if hint else '?'}" for name, hint in hints.items())
    return " ".join([schema, *fields]), kinds, hints


def _point(key: str, airspace: Airspace, height: float) -> Read:
    def read(value: object) -> Point:
        x, y, z = [*values.point(value), height][:3]  # its own height comes first
        if problem := airspace.problem((x, y, z)):
            raise BadInput(f"{key} {problem}")
        return x, y, z

    return read


def _one_of(what: str, names: Collection[str], read: Read = values.text) -> Read:
    def read_one(value: object) -> object:
        if (name := read(value)) not in names:
            there_is = ", ".join(names) or "none"
            raise BadInput(f"unknown {what} {quoted(name)}; this app has: {there_is}")
        return name

    return read_one


def line_of_long_key(text: str) -> int | None:
    """Return the line, from 1, of a key with too many parts; None where there is none."""
    long = next((key.start() for key in _KEY.finditer(text) if key[1]), None)
    return None if long is None else text.count("\n", 0, long) + 1


def text_of(path: Path) -> str:
    """Return the text of a plan file; raise `BadInput` if it cannot be one."""
    return decoded(content_of(path), path)


def content_of(path: Path, opener: Callable[[str, int], int] | None = None) -> bytes:
    """Return what is in a plan file, up to more than it may hold; raise `BadInput` if it cannot be read."""
    try:
        with open(path, "rb", opener=opener) as file:
            return file.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        said = f"cannot be read: {getattr(error, 'strerror', None) or error}"
        raise BadInput(f"{path}: {_UNREADABLE.get(type(error), said)}") from None


def decoded(content: bytes, path: object) -> str:
    """Return the text that a user brings; raise `BadInput`, from the error, if it is none."""
    if len(content) > LARGEST:
        raise BadInput(f"{path}: is larger than {LARGEST // 1024} KiB: this is not a plan file")
    try:
        return content.decode("utf-8-sig")  # some editors put a byte-order mark before the text
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        kind = " but UTF-16" * content.startswith((b"\xff\xfe", b"\xfe\xff"))
        raise BadInput(f"{path}:{line}: is not UTF-8 text{kind}: save it as UTF-8") from error


def parsed(
    path: object, text: str, advice: Callable[[str, int], str] = lambda *_: USUAL
) -> dict[str, Any]:
    """Return the data of a plan file's text; raise `BadInput` if it is not TOML."""
    try:
        if line := line_of_long_key(text):
            path = f"{path}:{line}"
            raise RecursionError
        return tomllib.loads(text)
    except RecursionError:
        raise BadInput(f"{path}: is nested too deep") from None
    except ValueError as error:
        said, end = f"{error}", ""
        if not isinstance(error, tomllib.TOMLDecodeError):  # Python's hint is for its programmers
            row = next((n for n, line in enumerate(text.split("\n"), 1) if _LONG.search(line)), 1)
            path = f"{path}:{row}"
            said = "a whole number has too many digits"
        if place := _PLACE.search(said):
            row = int(place[1] or text.rstrip().count("\n") + 1)
            path, shown = f"{path}:{row}", cut_off(text.split("\n")[row - 1].strip(), 80)
            end = f", column {place[2]}" if place[2] else ", at the end of the file"
            end += f", in `{printable(shown)}`; {advice(text, row)}"
            said = said[: place.start()]
        said = f"{said[:1].lower()}{said[1:]}{end}"
        raise BadInput(f"{path}: is not valid TOML: {said}") from None
