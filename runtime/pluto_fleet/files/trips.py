"""The trips of a mission: `[[mission.trip]]`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.actions import PICK, RELEASE, Action, Plain
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.model import NOTHING, Item, Point, Trip
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.text import quoted

from . import errors, values
from .app_fields import read_fields
from .items import check_items
from .limits import MASS

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App

    from .table import Table

BASIC = ("name", "action", "target", "source", "parameters", "item")
NOWHERE: Point = (0.0, 0.0, 0.0)
"""Stands in for a target that could not be read: the file is refused in the end."""


def read_trips(mission: Table, app: App, airspace: Airspace) -> list[Trip]:
    """Return a mission's trips, and tell what is wrong with each and with their order."""
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
        parameters=(_parameters(table, action) if action else None) or NOTHING,
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
