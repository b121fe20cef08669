"""The missions file: what is to be flown (docs/files.md)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import PICK, RELEASE, Action, Plain
from plutoc_runtime.domain.fields import Entity, FieldType
from plutoc_runtime.domain.model import Item, Point, Trip
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.text import quoted

from . import errors, values
from .reading import Document, Table, read
from .values import MASS

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission, Trip


ELSEWHERE = {
    Entity.MISSION: ("safe_time", "repeat", "evaluator", "at", "every"),
    Entity.TRIP: ("delay", "priority", "gap"),
}
"""Fields that other apps have: the message says why this app has none."""


def read_fields(table: Table, app: App, entity: Entity, basic: Sequence[str]) -> dict[str, Any]:
    """Return the fields beyond the basic ones, and report unknown keys."""
    fields = [field for field in app.fields if field.on is entity]
    keys = [*basic, *(field.name for field in fields)]
    for key in table.data:
        if key not in keys:
            table.problem(_unknown(key, keys, entity), key)
    given: dict[str, Any] = {}
    for field in fields:
        value = table.read(field.name, values.field_reader(field.type))
        if value is None:
            continue
        given[field.name] = value
        if field.type is FieldType.EVALUATOR and value not in app.evaluators:
            table.problem(_unknown_evaluator(str(value), list(app.evaluators)), field.name)
    return given


def _unknown(key: str, keys: Sequence[str], entity: Entity) -> str:
    if key in ELSEWHERE[entity]:
        return errors.no_such_field(key, entity.value, keys)
    return errors.unknown_key(key, keys, f"a {entity.value} of this app")


def _unknown_evaluator(name: str, evaluators: Sequence[str]) -> str:
    if not evaluators:
        return errors.no_evaluators()
    return errors.unknown_name("evaluator", name, evaluators, "this app has")


def check_items(trips: Sequence[tuple[Trip, Table]]) -> None:
    """Report every pick without a release, release without a pick, and second item aboard."""
    aboard: tuple[Item, Trip, Table] | None = None
    for trip, table in trips:
        if trip.item is None:
            if trip.action in (PICK, RELEASE):
                return  # its item is invalid: errors after it would be guesses
            continue
        if trip.action == PICK:
            if aboard is not None:
                carried, since, _ = aboard
                table.problem(
                    errors.carries_already(trip.item.name, carried.name, since.name), "item"
                )
            aboard = trip.item, trip, table
        elif trip.action == RELEASE:
            problem = _release(trip.item, aboard)
            if problem is not None:
                table.problem(problem, "item")
            aboard = None
    if aboard is not None:
        item, _, table = aboard
        table.problem(errors.never_released(item.name), "item")


def _release(item: Item, aboard: tuple[Item, Trip, Table] | None) -> str | None:
    if aboard is None:
        return errors.never_picked(item.name)
    carried, since, _ = aboard
    if carried.name != item.name:
        return errors.other_item(item.name, carried.name, since.name)
    if carried.mass != item.mass:
        return errors.other_mass(item.name, since.name)
    return None


BASIC = ("name", "action", "target", "source", "parameters", "item")
NOWHERE: Point = (0.0, 0.0, 0.0)
"""A placeholder for an invalid target: the file is refused in the end."""


def read_trips(mission: Table, app: App, airspace: Airspace) -> list[Trip]:
    """Return a mission's trips, and report what is wrong with each and with their order."""
    names: dict[str, Table] = {}
    trips: list[tuple[Trip, Table]] = []
    for index, table in enumerate(mission.tables("trip", "mission.trip")):
        trips.append((_trip(table, index, app, airspace, names), table))
    if mission.data.get("trip", []) == []:
        mission.problem(mission.document.words.no_trips())
    check_items(trips)
    return [trip for trip, _ in trips]


def _trip(table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]) -> Trip:
    mission, number = table.who, str(index + 1)
    table.who = f"{mission}, trip {number}"
    name = table.read("name", values.name) or number
    if name != number:
        table.who = f"{mission}, trip {quoted(name)}"
    other = names.setdefault(name, table)
    if other is not table:
        table.problem(errors.not_unique("trip", name, other.line("name")), "name")
    given = read_fields(table, app, Entity.TRIP, BASIC)
    action = _action(table, app)
    target = _point(table, "target", airspace, required=True)
    return app.trip(
        name=name,
        action=action.name if action else "",
        target=target or NOWHERE,
        source=_point(table, "source", airspace, required=False),
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


def _point(table: Table, key: str, airspace: Airspace, *, required: bool) -> Point | None:
    height = airspace.cruise_height
    point = table.read(key, partial(values.position, height=height), required=required)
    if point is not None:
        problem = airspace.problem(point)
        if problem is not None:
            table.problem(f"{table.called(key)} {problem}", key)
    return point


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
            value = given.read(parameter.name, partial(values.parameter, kind=parameter.type))
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
    mass = item.read("mass", partial(values.quantity, kind=Type.MASS, limit=MASS), required=True)
    return None if name is None or mass is None else Item(name=name, mass=mass)


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file; raise `BadInput` with everything that is wrong with it."""
    return missions_of(read(path), app, airspace)


def missions_of(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file that was read, as `load_missions` does."""
    missions = read_missions(document, app, airspace)
    document.refuse_if_bad()
    return missions


def read_missions(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions as far as they are valid; the document collects what is wrong."""
    top = Table(document, document.data)
    top.only(("mission",), "a missions file")
    names: dict[str, Table] = {}
    missions = [
        _mission(table, index, app, airspace, names)
        for index, table in enumerate(top.tables("mission", "mission"))
    ]
    if document.data.get("mission", []) == []:
        top.problem(errors.none_given("mission"))
    return missions


def _mission(
    table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]
) -> Mission[Any]:
    table.who = f"mission {index + 1}"
    name = table.read("name", values.name) or str(index + 1)
    table.who = f"mission {quoted(name)}"
    other = names.setdefault(name, table)
    if other is not table:
        table.problem(errors.not_unique("mission", name, other.line("name")), "name")
    given = read_fields(table, app, Entity.MISSION, ("name", "trip"))
    trips = read_trips(table, app, airspace)
    return app.mission(name=name, trips=trips, index=index, **given)
