"""The two files that a user writes: the fleet, with its map and its world, and the missions.

The library reads them by the same functions, and adds what only it knows: lines, named places, areas, lists,
what is promised, and how real drones are reached.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from math import dist
from typing import TYPE_CHECKING, Any, TypeVar

from ..domain import values
from ..domain.actions import PICK, RELEASE
from ..domain.airspace import Airspace
from ..domain.app import needs_library
from ..domain.errors import BadInput
from ..domain.fields import Entity, FieldType
from ..domain.fleet_data import DroneData, Feature, FleetData, Source, WorldData
from ..domain.model import Item, Point
from ..domain.motion import motion_of
from ..domain.text import mass, number, printable, quoted
from ..domain.values import Keys, Table, read_parameters

if TYPE_CHECKING:
    from pathlib import Path

    from ..domain.app import App
    from ..domain.model import Mission, Trip
    from ..domain.motion import Motion

LIBRARY = {"deadline": "", "window": "", "after": "", "each": "", "area": "[areas]"}
"""Keys of a mission that only the library reads, and what it needs for them."""
MISSIONS = ("mission",)
FLEET = ("map", "fleet", "motion", "drone", "navigation", "localization", "tracker", "world")
"""What stands in the two files."""
REAL: Keys = dict.fromkeys(
    ("apart", "silence", "navigation", "localization", "tracker")
)  # of [fleet]
T = TypeVar("T", bound=Table)
HOME_SIZE = 0.1  # the diameter of a drone on the ground, in metres


def load_fleet(path: Path, app: App) -> FleetData:
    """Return a fleet file's data, without what only real flights need."""
    top = _top(path, FLEET)
    airspace = read_map(top.table("map"))
    fleet = FleetData(
        airspace=airspace or Airspace(),
        drones=[DroneData(**given) for _, given in read_drones(top, app, airspace)],
        motion=read_motion(top),
        world=read_world(top, app.parts),
        **read_behaviour(top.table("fleet")),
    )
    top.refuse_if_bad(f"{path}")
    return fleet


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file, each of the app's own class."""
    top = _top(path, MISSIONS)
    missions: list[Any] = []
    names: dict[str, Table] = {}
    for index, table in enumerate(top.tables("mission", needed=True)):
        for key in filter(table.data.__contains__, LIBRARY):
            table.problem(needs_library(key, LIBRARY[key]), key)
            top.refuse_if_bad(f"{path}")  # once: the library reads the rest
        missions.append(app.mission(**read_mission(table, index, app, airspace, names)))
    top.refuse_if_bad(f"{path}")
    return missions


def _top(path: Path, keys: Sequence[str]) -> Table:
    try:
        data = tomllib.loads(path.read_text("utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        said = printable(getattr(error, "strerror", None) or f"{error}")
        raise BadInput(f"{path}: cannot be read: {said}") from None
    table = Table(data)
    table.read({}, dict.fromkeys(keys))
    return table


# Missions


def read_mission(
    table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]
) -> dict[str, Any]:
    """Return what a mission is made of; `names` are those of the missions before it."""
    keys: Keys = {"name": values.name, "trip": None, **dict.fromkeys(LIBRARY)}
    given = table.read(*with_fields(app, Entity.MISSION, {}, keys))
    given = {"name": f"{index + 1}", **given}
    table.differs("name", given["name"], "mission", names)
    return {**given, "index": index, "trips": read_trips(table, app, airspace)}


def read_trips(table: Table, app: App, airspace: Airspace) -> list[Trip]:
    """Return a mission's trips."""
    point = partial(values.point_on, airspace, airspace.cruise_height, table.point)
    needed: Keys = {"action": partial(values.one_of, app.actions), "target": point}
    others: Keys = {"name": values.name, "source": point, "parameters": None, "item": None}
    keys = with_fields(app, Entity.TRIP, needed, others)
    trips: list[Any] = []
    names: dict[str, Table] = {}
    tables = [*table.tables("trip", needed=not table.data.get("area"))]
    for index, one in enumerate(tables):
        for part in app.parts:
            one.data = part.prepared(one.data)
        given = {"name": f"{index + 1}", **one.read(*keys)}
        one.differs("name", given["name"], "trip", names)
        if action := app.actions.get(given["action"]):
            given["parameters"] = read_parameters(one.table("parameters"), action.parameters)
            given["item"] = _item(one, action.name)
        trips.append(app.trip(**given, index=index))
    for index, said in _wrongly_carried(trips):
        tables[index].problem(said, "item")
    return trips


def _item(table: Table, action: str) -> Item | None:
    if action not in (PICK, RELEASE):
        if "item" in table.data:
            table.problem(f"{action} takes no item: only {PICK} and {RELEASE} do", "item")
        return None
    if "item" not in table.data:
        example = 'item = { name = "pills", mass = "4 g" }'
        table.problem(f"{action} needs an item, such as {example}", "item", is_missing=True)
        return None
    given = table.table("item").read({"name": values.name, "mass": values.MASS})
    return None if None in given.values() else Item(**given)


def readers_of(app: App) -> dict[Any, Callable[[Any], Any]]:
    """Return how values of fields are read, by their types."""
    readers: dict[Any, Any] = {
        **values.READERS,
        FieldType.EVALUATOR: partial(values.one_of, app.evaluators),
    }
    for part in app.parts:
        readers.update(part.readers(app))
    return readers


def with_fields(
    app: App, entity: Entity, needed: Keys, others: Keys
) -> tuple[Keys, Keys, Mapping[str, str]]:
    """Return what `Table.read` takes: these keys, and the fields of this app's missions or trips."""
    fields = {field.name: field for field in app.fields if field.on is entity}
    readers = readers_of(app)
    keys = {name: readers[field.type] for name, field in fields.items()}
    hints = {name: field.hint for name, field in fields.items() if field.hint}
    return {**needed, **{name: keys[name] for name in hints}}, {**others, **keys}, hints


def _wrongly_carried(trips: Sequence[Trip]) -> Iterator[tuple[int, str]]:
    """Yield what is wrong with items that are picked and released, with the index of a trip."""
    picked: Trip | None = None
    for index, trip in enumerate(trips):
        if trip.action not in (PICK, RELEASE):
            continue
        if trip.item is None:
            return  # it is invalid: errors after it would be guesses
        aboard = picked.item if picked else None
        if aboard != (trip.item if trip.action == RELEASE else None):
            there = (
                "nothing is" if picked is None else f"{_named(picked)}, of trip {picked.name}, is"
            )
            yield index, f"cannot {trip.action.removesuffix('_item')} {_named(trip)}: {there} aboard"
        picked = trip if trip.action == PICK else None
    if picked is not None:
        yield picked.index, f"picks {_named(picked)}, which no trip after it releases"


def _named(trip: Trip) -> str:
    return f"{quoted(trip.item.name)} ({mass(trip.item.mass)})" if trip.item else ""


# Fleets


def read_map(table: Table) -> Airspace | None:
    """Return the map of `[map]`; None if it cannot be read, so that nothing is held against it."""
    before = len(table.problems)
    plain = Airspace()
    keys: Keys = {"size": values.size, "cruise_height": values.HEIGHT, "ceiling": values.HEIGHT}
    shown = dict.fromkeys(("origin", "bearing", "image", "north", "places", "zones"))
    given = table.read({}, {**keys, "no_fly": values.areas, **shown})
    cruise = given.get("cruise_height", plain.cruise_height)
    ceiling = given.setdefault("ceiling", max(plain.ceiling, cruise))
    if cruise > ceiling:
        said = f"cruise_height, {number(cruise)} m, is above the ceiling, {number(ceiling)} m"
        table.problem(said, "cruise_height")
    return Airspace(**given) if len(table.problems) == before else None


def read_behaviour(table: Table, real: Keys = REAL) -> dict[str, Any]:
    """Return what `[fleet]` says; `real` reads what only real flights need."""
    keys: Keys = {
        "after_trip": values.after_trip,
        "max_airborne": values.count,
        "charges_at_home": values.boolean,
    }
    return table.read({}, {**keys, **real})


def read_motion(top: Table) -> Motion:
    """Return how the drones move: like Crazyflies, but for what `[motion]` says."""
    return motion_of(top.table("motion").read({}, values.MOTION))


def read_drones(top: T, app: App, airspace: Airspace | None) -> Iterator[tuple[T, dict[str, Any]]]:
    """Yield each drone's table, and what it says, without what only real flights need."""
    kinds = [one.name for one in app.categories]
    needed: dict[str, Any] = {"id": values.name, "category": partial(values.one_of, kinds)}
    needed["home"] = partial(values.point_on, airspace, 0.0, values.point)
    others = dict.fromkeys(("uri", "navigation", "options", "parameters"))
    if len(kinds) == 1:  # it is the default
        others["category"] = needed.pop("category")
    hints = {"category": f"; this app has: {', '.join(kinds)}"}
    names: dict[str, Table] = {}
    homes: dict[str, Point] = {}
    for table in top.tables("drone", "id", needed=True):
        given = {"category": kinds[0], **table.read(needed, others, hints)}
        table.differs("id", given["id"], "drone", names)
        home = given["home"]
        if near := [who for who in homes if home and dist(home, homes[who]) < HOME_SIZE]:
            said = f"home is where {near[0]} has its own: each needs a place to stand"
            table.problem(said, "home")
        if home:
            homes[table.who] = home
        yield table, given


def read_world(top: Table, parts: Sequence[Any] = ()) -> WorldData | None:
    """Return the world that is simulated, if the file describes one, as an app of these parts sees it."""
    table = top.table("world")
    if "world" not in top.data or table.data.keys() == {"wind"}:  # which the library reads
        return None
    table.read({}, dict.fromkeys(("background", "feature", "source", "mover", "event", "wind")))
    levels = table.table("background")
    seen: Keys = {"kind": values.name, "at": values.corner}
    radius: Keys = {"radius": values.RADIUS}
    source: Keys = {"quantity": values.name, "at": values.corner, "peak": values.real, **radius}
    features = [one.read(seen, radius) for one in table.tables("feature")]
    sources = [one.read(source) for one in table.tables("source")]
    return WorldData(
        features=tuple(Feature(**one) for one in features),
        sources=tuple(Source(**one) for one in sources),
        movers=tuple(one for part in parts for one in part.movers(table)),
        events=tuple(one for part in parts for one in part.happens(table)),
        background=levels.read({}, dict.fromkeys(levels.data, values.real)),
    )
