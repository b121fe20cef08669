"""Validation of trips and missions that a hook has made or changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ParamSpec, cast

from ..domain.errors import ANY_ERROR
from ..domain.guard import unless_by_a_person
from ..domain.model import Item
from ..domain.plain import number_of, plain_of
from ..domain.status import Status, TripStatus
from ..domain.text import class_of, said, shown
from ..domain.values import parameters
from .plain_data import keepable

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.model import Mission, Point, Trip

P = ParamSpec("P")


def _of_any_class(check: Callable[P, str | None]) -> Callable[P, str | None]:
    """Take all that a check raises for a fault: what a hook has put there may be of any class."""

    def checked(*args: P.args, **named: P.kwargs) -> str | None:
        try:
            return check(*args, **named)
        except ANY_ERROR as error:
            unless_by_a_person(error)
            return f"it cannot be read: {said(error)}"

    return checked


@_of_any_class
def unsound(app: App, airspace: Airspace, trip: object) -> str | None:
    """Return what is wrong with a trip, or None.

    A point without a height gets the map's default, and a parameter with a unit is read.
    """
    if not issubclass(type(trip), app.trip):
        return f"it must be a Trip of this app, not {class_of(trip)}"
    found = cast("Trip", trip)
    if (wrong := _wrong_facts(found, _TRIP)) is not None:
        return wrong
    wrong = _wrong_action(app, found) or _wrong_place(airspace, found)
    return wrong and f"trip {found.name}: {wrong}"


@_of_any_class
def unsound_mission(app: App, mission: Mission[Any]) -> str | None:
    """Return what is wrong with the mission's own attributes, or None."""
    wrong = _wrong_facts(mission, _MISSION)
    kind = app.trip
    for trip in () if wrong else mission.completed_trips:
        if type(trip) is not kind:
            return f"completed_trips holds {class_of(trip)}"
    return wrong


_TRIP: Mapping[str, tuple[type, ...]] = {
    **dict.fromkeys(("name", "action", "reason"), (str,)),
    "status": (TripStatus,),
    **dict.fromkeys(("attempt", "index"), (int,)),
    "added": (bool,),
    "item": (type(None), Item),
    **dict.fromkeys(("start_time", "end_time"), (type(None), float, int)),
}

_MISSION: Mapping[str, tuple[type, ...]] = {
    **dict.fromkeys(("name", "reason"), (str,)),
    "completed_trips": (list,),
    "status": (Status,),
    **dict.fromkeys(("round", "attempts", "index", "last_result"), (int,)),
    "promises": (dict,),
    "deadline": (type(None), int, float),
    "late": (bool,),
}
"""The attributes that the runtime relies on, and their types."""


def _wrong_facts(of: object, facts: Mapping[str, tuple[type, ...]]) -> str | None:
    for name, types in facts.items():
        value = getattr(of, name)
        if type(value) not in types:
            return f"its {name} must be {types[-1].__name__}, not {class_of(value)}"
        if isinstance(value, int) and abs(value) >= _MOST:
            return f"its {name} must be a number, not {shown(value)}"
    return None


_MOST = 1 << 31  # the bound of counters, which are stored in 31 bits


def _wrong_action(app: App, trip: Trip) -> str | None:
    action = app.actions.get(trip.action)
    if action is None:
        return f"there is no action {trip.action!r}"
    if not isinstance(trip.parameters, Mapping):
        return f"its parameters must be a dict, not {class_of(trip.parameters)}"
    given = dict(trip.parameters) if trip.parameters else {}
    for name, value in given.items():
        plain = given[name] = plain_of(value)
        if plain is None or plain != keepable(plain):
            return f"its parameter {shown(name)} must be a number or a text, not {shown(value)}"
    try:
        read = parameters(action, {n if type(n) is str else shown(n): v for n, v in given.items()})
    except ValueError as error:
        return str(error)
    if given:  # "50 mg", as in a missions file
        trip.parameters = {
            n: read[n] if type(value) is str else value for n, value in given.items()
        }
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
        if given != point:
            setattr(trip, name, point)
    return None


def _point(given: object, height: float) -> Point | None:
    if not isinstance(given, (tuple, list)) or len(given) not in (2, 3):
        return None
    numbers = [number_of(value) for value in given]
    if None in numbers:
        return None
    x, y, z = numbers if len(given) == 3 else (*numbers, height)
    return cast("Point", (x, y, z))
