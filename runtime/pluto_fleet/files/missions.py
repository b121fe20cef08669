"""The missions file: what is to be flown (docs/files.md)."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.domain import values
from ..shared.domain.actions import PICK, RELEASE, Action, Plain
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.model import Item, Point, Trip
from ..shared.domain.text import quoted
from ..shared.domain.values import wrongly_carried
from . import areas as areas_of
from . import errors
from .lists import each_row
from .promises import KEYS, misplaced, read_promises
from .reading import Document, Table, read

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Mission, Trip
    from .landmarks import Landmarks


MOST_OF_LISTS = 1_000
"""After so many problems no further row of a list is read."""

ELSEWHERE = {
    Entity.MISSION: ("safe_time", "repeat", "evaluator", "at", "every"),
    Entity.TRIP: ("delay", "priority", "gap"),
}
"""Fields that other apps have: the message says why this app has none."""


def only_fields(
    table: Table, app: App, entity: Entity, basic: Sequence[str], what: str | None = None
) -> None:
    """Report the keys that are neither basic ones nor fields that the app's graph needs."""
    keys = [*basic, *(field.name for field in app.fields if field.on is entity)]
    what = what or f"a {entity.value}"
    for key in table.data:
        if key not in keys:
            table.problem(_unknown(key, keys, entity, what), key, of_key=True)


def _unknown(key: str, keys: Sequence[str], entity: Entity, what: str) -> str:
    if key in ELSEWHERE[entity]:
        return errors.no_such_field(key, what, keys)
    return errors.unknown_key(key, keys, f"{what} of this app")


def read_fields(table: Table, app: App, entity: Entity) -> dict[str, Any]:
    """Return the fields beyond the basic ones, and report those that must be there and are not."""
    given: dict[str, Any] = {}
    for field in app.fields:
        if field.on is not entity:
            continue
        if field.name not in table.data:
            if field.hint:
                table.problem(table.document.words.field_missing(field), field.name)
            continue
        value = table.read(field.name, values.FIELD[field.type])
        if value is not None:
            given[field.name] = value
            if field.type is FieldType.EVALUATOR and value not in app.evaluators:
                said = errors.unknown_name("evaluator", value, [*app.evaluators], "this app has")
                table.problem(said, field.name)
    return given


BASIC = ("name", "action", "target", "source", "parameters", "item")
NOWHERE: Point = (0.0, 0.0, 0.0)
"""A placeholder for an invalid target: the file is refused in the end."""


def read_trips(mission: Table, app: App, airspace: Airspace) -> list[Trip]:
    """Return a mission's trips, and report what is wrong with each and with their order."""
    names: dict[str, Table] = {}
    trips: list[tuple[Trip, Table]] = []
    for index, table in enumerate(mission.tables("trip", "mission.trip")):
        trips.append((_trip(table, index, app, airspace, names), table))
    if mission.data.get("trip", []) == [] == mission.data.get("area", []):
        mission.problem(mission.document.words.no_trips())
    for place, problem in wrongly_carried([trip for trip, _ in trips]):
        trips[place][1].problem(problem, "item")
    found = [trip for trip, _ in trips]
    areas: dict[str, Table] = {}
    for number, table in enumerate(mission.tables("area", "mission.area"), 1):
        prefix = areas_of.named(table, number, areas)
        found += _trips_of_area(table, prefix, found, app, airspace, names)
    return found


def _trips_of_area(
    table: Table,
    prefix: str,
    before: Sequence[Trip],
    app: App,
    airspace: Airspace,
    names: dict[str, Table],
) -> list[Trip]:
    """Return the trips that an area makes."""
    only_fields(table, app, Entity.TRIP, areas_of.BASIC, "an area")
    action = _action(table, app)
    if action is not None and action.name in (PICK, RELEASE):
        table.problem(errors.item_in_area(action.name), "action")
    parameters = _parameters(table, action) if action else {}
    given = read_fields(table, app, Entity.TRIP)
    last, trips, is_told = before[-1].target if before else None, list[Any](), False
    for count, place in enumerate(areas_of.read_places(table, airspace, last), 1):
        name = f"{prefix}{count}"
        other = names.setdefault(name, table)
        if other is not table and not is_told:
            table.problem(errors.makes_another(name, other.line("name")))
            is_told = True  # one says all
        trip = app.trip(
            name=name,
            action=action.name if action else "",
            target=place,
            parameters={**parameters},
            index=len(before) + count - 1,
            **given,
        )
        trips.append(trip)
    return trips


def _trip(table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]) -> Trip:
    mission, number = table.who, str(index + 1)
    known = table.valid_name("name") or number
    table.who = f"{mission}, trip {number if known == number else quoted(known)}"
    only_fields(table, app, Entity.TRIP, BASIC)
    name = table.read("name", values.name) or number
    table.differs("trip", "name", name, names)
    action = _action(table, app)
    height = airspace.cruise_height
    target = table.position("target", airspace, height, required=True)
    source = table.position("source", airspace, height)
    given = read_fields(table, app, Entity.TRIP)
    return app.trip(
        name=name,
        action=action.name if action else "",
        target=target or NOWHERE,
        source=source,
        parameters=_parameters(table, action) if action else {},
        item=_item(table, action),
        index=index,
        **given,
    )


def _action(table: Table, app: App) -> Action | None:
    name = table.read("action", values.text, required=True)
    if name is None or name in app.actions:
        return app.actions.get(name or "")
    table.problem(errors.unknown_name("action", name, list(app.actions), "this app has"), "action")
    return None


def _parameters(table: Table, action: Action) -> dict[str, Plain]:
    given = table.table("parameters")
    known = [parameter.name for parameter in action.parameters]
    filled: dict[str, Plain] = {}
    if given is not None:
        for key in given.data:
            if key not in known:
                given.problem(errors.unknown_parameter(action.name, key, known), key)
    for parameter in action.parameters:
        if given is not None and parameter.name in given.data:
            value = given.read(parameter.name, values.PARAMETER[parameter.type])
        else:
            value = parameter.default
            if value is None:
                said = errors.parameter_missing(action.name, parameter.name)
                table.problem(said, "parameters", parameter.name)
        if value is not None:
            filled[parameter.name] = value
    return filled


def _item(table: Table, action: Action | None) -> Item | None:
    item = table.table("item")
    if item is None:
        if action is not None and action.name in (PICK, RELEASE) and "item" not in table.data:
            said = table.document.words.item_missing(action.name)
            table.problem(said, "item", near="action")
        return None
    if action is not None and action.name not in (PICK, RELEASE):
        table.problem(errors.item_unwanted(action.name, (PICK, RELEASE)), "item")
    item.who = f"{table.who}, item"
    item.only(("name", "mass"), "an item")
    name = item.read("name", values.name, required=True)
    mass = item.read("mass", values.MASS, required=True)
    return None if name is None or mass is None else Item(name=name, mass=mass)


def load_missions(
    path: Path, app: App, airspace: Airspace, landmarks: Landmarks | None = None
) -> list[Mission[Any]]:
    """Return the missions of a file; raise `BadInput` with everything that is wrong with it.

    `landmarks` are the places and zones that it may name.
    """
    document = read(path)
    document.landmarks = landmarks
    return missions_of(document, app, airspace)


def missions_of(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file that was read, as `load_missions` does."""
    missions = read_missions(document, app, airspace)
    document.refuse_if_bad()
    return missions


def read_missions(
    document: Document, app: App, airspace: Airspace, known: Collection[str] = ()
) -> list[Mission[Any]]:
    """Return the missions as far as they are valid; the document collects what is wrong.

    `known` are the missions that fly already.
    """
    top = Table(document, document.data)
    top.only(("mission",), "a missions file")
    names: dict[str, Table] = {}
    tables = [*each_row(top)]
    missions: list[Mission[Any]] = []
    for index, table in enumerate(tables):
        if table.row and len(document.problems) > MOST_OF_LISTS:
            break  # the same is wrong in row after row
        missions.append(_mission(table, index, app, airspace, names))
    if document.data.get("mission", []) == []:
        top.problem(errors.none_given("mission"))
    for place, said in misplaced(missions, known) if document.problems == [] else ():
        tables[place].problem(said, "after")
    document.given = [None if table.row else table.data for table in tables]
    return missions


def _mission(
    table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]
) -> Mission[Any]:
    number = str(index + 1)
    known = table.valid_name("name") or ("name" not in table.data and number)
    table.who = f"mission {quoted(known) if known else number}"
    if table.row:
        table.who += f" ({table.row})"
    only_fields(table, app, Entity.MISSION, ("name", "trip", "area", *KEYS))
    name = table.read("name", values.name) or number
    table.differs("mission", "name", name, names)
    given = read_fields(table, app, Entity.MISSION)
    promises = read_promises(table, app)
    trips = read_trips(table, app, airspace)
    return app.mission(name=name, trips=trips, index=index, promises=promises, **given)
