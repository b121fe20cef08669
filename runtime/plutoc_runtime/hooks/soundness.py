"""Validation of the trips of a mission that a hook has made or changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, cast

from ..domain.actions import PICK, RELEASE
from ..domain.fields import Entity, wrong_field
from ..domain.guard import unless_by_a_person
from ..domain.keeper import keep, keeper_of, put, put_anew, read_only
from ..domain.model import Item
from ..domain.plain import number_of, plain_of
from ..domain.text import class_of, said, shown
from ..domain.values import LONGEST_NAME, Table, read_parameters
from .plain_data import keepable

if TYPE_CHECKING:
    from typing import Any

    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.model import Mission, Point, Trip

MOST_TRIPS = 10_000
"""Trips of one mission in one round, with those completed or taken away; a hook adds no more."""


def unsound(app: App, airspace: Airspace, trip: object) -> str | None:
    """Return what is wrong with a trip, or None.

    A point without a height gets the map's default, and a parameter with a unit is read.
    """
    if type(trip) is not app.trip:
        return f"it must be a Trip of this app, not {class_of(trip)}"
    try:
        for part in app.parts:
            put(trip, **part.prepared({"target": trip.target}))
        wrong = (
            _wrong_name(trip)
            or _wrong_action(app, trip)
            or _wrong_place(airspace, trip)
            or _wrong_item(trip)
            or wrong_field(app.fields, Entity.TRIP, trip, app.evaluators)
            or next(filter(None, (part.wrong(app, trip) for part in app.parts)), None)
        )
    except BaseException as error:  # noqa: BLE001 - what a hook has put there may be of any class
        unless_by_a_person(error)
        wrong = f"it cannot be read: {said(error)}"
    return wrong and f"trip {trip.name if type(trip.name) is str else shown(trip.name)}: {wrong}"


def taken_in(mission: Mission[Any], trip: Trip, *, added: bool) -> str | None:
    """Make a sound trip of a hook one of its mission, with a name of its own; return why that cannot be."""
    keeper = keeper_of(mission)
    assert keeper is not None
    if keeper_of(trip) is not None:
        return f"trip {trip.name} has been used already: make a new Trip each time"
    if len(keeper.names) >= MOST_TRIPS:
        return f"the mission has had {MOST_TRIPS:,} trips in this round, and no hook may add more"
    name = trip.name
    while trip.name in keeper.names:
        keeper.names[name] += 1
        put(trip, name=f"{name} {keeper.names[name]}")
    put_anew(trip)
    put(trip, added=added)
    keep(keeper, mission, (trip,))
    return None


def _wrong_name(trip: Trip) -> str | None:
    if type(trip.name) is not str or not 0 < len(trip.name) <= LONGEST_NAME:
        return f"its name must be a text of 1 to {LONGEST_NAME} characters, not {shown(trip.name)}"
    if type(trip.index) is not int or abs(trip.index) >= _MOST:
        return f"its index must be a number, not {shown(trip.index)}"
    return None


_MOST = 1 << 31  # the bound of counters, which are stored in 31 bits


def _wrong_action(app: App, trip: Trip) -> str | None:
    action = app.actions.get(trip.action) if type(trip.action) is str else None
    if action is None:
        return f"there is no action {trip.action!r}"
    if not isinstance(trip.parameters, Mapping):
        return f"its parameters must be a dict, not {class_of(trip.parameters)}"
    given = dict(trip.parameters)
    for name, value in given.items():
        plain = given[name] = plain_of(value)
        if plain is None or plain != keepable(plain):
            return f"its parameter {shown(name)} must be a number or a text, not {shown(value)}"
    named = {name if type(name) is str else shown(name): given[name] for name in given}
    table = Table(named, who=action.name)
    read = read_parameters(table, action.parameters)
    if table.problems:
        return table.problems[0].sentence
    # "50 mg" is read as in a missions file, and what is left out has its default
    numbers = {name: value for name, value in given.items() if type(value) is not str}
    put(trip, parameters=read_only({**read, **numbers}))
    return None


def _wrong_place(airspace: Airspace, trip: Trip) -> str | None:
    for name in ("source", "target"):
        given = getattr(trip, name)
        if given is None and name == "source":
            continue
        point = _point(given, airspace.cruise_height)
        if point is None:
            return f"its {name} must be (x, y) or (x, y, z) in metres, not {shown(given)}"
        problem = airspace.problem(point)
        if problem is not None:
            return problem
        put(trip, **{name: point})
    return None


def _point(given: object, height: float) -> Point | None:
    if not isinstance(given, (tuple, list)) or len(given) not in (2, 3):
        return None
    numbers = [number_of(value) for value in given]
    if None in numbers:
        return None
    x, y, z = numbers if len(given) == 3 else (*numbers, height)
    return cast("Point", (x, y, z))


def _wrong_item(trip: Trip) -> str | None:
    item: object = trip.item
    carries = trip.action in (PICK, RELEASE)
    if carries is not (item is not None):
        return f"{trip.action} {'needs an' if carries else 'takes no'} item"
    if item is None:
        return None
    if type(item) is not Item:
        return f"its item must be an Item, not {class_of(item)}"
    mass = number_of(item.mass)
    if type(item.name) is not str or not 0 < len(item.name) <= LONGEST_NAME:
        return f"the name of its item must be a text, not {shown(item.name)}"
    if mass is None or mass < 0.0:
        return f"the mass of its item must be a number of kilograms, not {shown(item.mass)}"
    put(trip, item=Item(name=item.name, mass=mass))
    return None
