"""Is a trip that a hook made or changed one that a drone could be sent on?"""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .airspace import Airspace
    from .core import Core
    from .model import Point, Trip


def unsound(core: Core, trip: object) -> str | None:
    """Return what is wrong with a trip, or None; a place without a height gets the map's."""
    if not isinstance(trip, core.app.trip):
        return f"it must be a Trip of this app, not {type(trip).__name__}"
    return _wrong_action(core, trip) or _wrong_place(core.airspace, trip)


def _wrong_action(core: Core, trip: Trip) -> str | None:
    action = core.app.actions.get(trip.action) if isinstance(trip.action, str) else None
    if action is None:
        return f"there is no action {trip.action!r}"
    if not isinstance(trip.parameters, Mapping):
        return f"its parameters must be a dict, not {type(trip.parameters).__name__}"
    known = {parameter.name: parameter.default for parameter in action.parameters}
    for given in trip.parameters:
        if given not in known:
            return f"{trip.action} has no parameter {given!r}"
    for name, default in known.items():
        if default is None and name not in trip.parameters:
            return f"{trip.action} needs the parameter {name!r}"
    return None


def _wrong_place(airspace: Airspace, trip: Trip) -> str | None:
    for name in ("source", "target"):
        given = getattr(trip, name)
        if given is None and name == "source":
            continue
        point = _point(given, airspace.cruise_height)
        if point is None:
            return f"its {name} must be (x, y) or (x, y, z) in metres, not {given!r}"
        problem = airspace.problem(point)
        if problem is not None:
            return problem
        if given != point:
            setattr(trip, name, point)
    return None


def _point(given: object, height: float) -> Point | None:
    if not isinstance(given, (tuple, list)) or len(given) not in (2, 3):
        return None
    if not all(isinstance(value, (int, float)) and isfinite(value) for value in given):
        return None
    x, y, z = given if len(given) == 3 else (*given, height)
    return x, y, z
