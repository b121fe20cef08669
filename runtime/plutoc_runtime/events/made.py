"""Missions that creators make: what may be wrong with one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any

from ..domain.fields import Entity, time_of_day, wrong_field
from ..domain.keeper import keeper_of, trips_of
from ..domain.text import class_of, quoted
from ..domain.values import is_name
from ..fleet.reach import miss_of
from ..hooks.soundness import unsound

if TYPE_CHECKING:
    from ..domain.model import Trip
    from ..flow.mission import Core


def wrong_mission(core: Core, made: Any) -> str | None:
    """Return what is wrong with a mission that a creator has made, or None."""
    if type(made) is not core.app.mission:
        return f"it must be a Mission of this app or None, not {class_of(made)}"
    if keeper_of(made) is not None:
        return f"mission {made.name} is in the app already: make a new one"
    if not is_name(made.name):
        return "its name must be a text that can be shown"
    trips = trips_of(made)
    if not trips:
        return f"mission {made.name} has no trips"
    if len({id(trip) for trip in trips}) != len(trips):
        return f"mission {made.name} has a trip twice"
    wrong = [unsound(core.app, core.airspace, trip) for trip in trips]
    fields = wrong_field(core.app.fields, Entity.MISSION, made, core.app.evaluators)
    promises = _wrong_promises(made.promises)
    return next(filter(None, [*wrong, fields, promises]), None) or _beyond_all(core, trips)


def _wrong_promises(promises: object) -> str | None:
    """Return what is wrong with what a mission promises, or None."""
    if not isinstance(promises, Mapping):
        return f'its promises must be like {{"deadline": 60.0}}, not {class_of(promises)}'
    for key, value in promises.items():
        if key == "after":
            if isinstance(value, str) or not isinstance(value, Sequence):
                return "its promise after must be a list of missions' names"
            if strange := [one for one in value if not is_name(one)]:
                return f"its promise after has {class_of(strange[0])}, which is no mission's name"
        elif key not in ("deadline", "opens"):
            return f"its promises have {quoted(str(key))}; there may be: deadline, opens, after"
        elif not _is_moment(value):
            return f'its promise {key} must be seconds from now, or an hour such as "08:00"'
    return None


def _is_moment(value: object) -> bool:
    """Return whether it says when: seconds from now, or an hour."""
    if isinstance(value, str):
        try:
            time_of_day(value)
        except ValueError:
            return False
        return True
    numbers = (int, float)
    return type(value) in numbers and isfinite(value) and value >= 0.0  # type: ignore[arg-type, operator]


def _beyond_all(core: Core, trips: Sequence[Trip]) -> str | None:
    """Return why no drone of the fleet could ever fly these trips, or None."""
    for trip in trips:
        misses = [
            miss_of(core.app, core.airspace, drone.category, drone.home, (trip,))
            for drone in core.fleet.drones
        ]
        if None not in misses:
            reasons = dict.fromkeys(miss.reason for miss in misses if miss)
            return f"trip {trip.name}: {'; '.join(reasons)}"
    return None
