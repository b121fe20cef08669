"""Reading a plan that was kept before it was finished: as a page has drawn it, which no missions file may be."""

from __future__ import annotations

from datetime import time
from typing import TYPE_CHECKING, Any

from ...files.reading import parsed
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity
from .shape import TRIP_KEYS, Shape, fields_of

if TYPE_CHECKING:
    from ...app import App


def unfinished_shapes(text: str, app: App, file: str) -> list[Shape]:
    """Return the missions of a text, without keys; raise `BadInput` if no page can have drawn them.

    What they hold is checked when they are taken into a plan.
    """
    data = parsed(file, text).data
    missions = data.get("mission", [])
    if data.keys() - {"mission"} or not isinstance(missions, list):
        raise BadInput(f"{file}: is no plan")
    return [_mission(one, number, app, file) for number, one in enumerate(missions, 1)]


def _mission(given: Any, number: int, app: App, file: str) -> Shape:
    trips = given.get("trip", []) if isinstance(given, dict) else None
    if not isinstance(trips, list) or not all(isinstance(one, dict) for one in trips):
        raise BadInput(f"{file}: mission {number} is none")
    rest = {key: _plain(value) for key, value in given.items() if key != "trip"}
    match rest.pop("window", None):
        case [opens, deadline]:
            rest |= {"opens": opens, "deadline": deadline}
    if isinstance(rest.get("after"), str):
        rest["after"] = [rest["after"]]
    keys = (*TRIP_KEYS, *fields_of(app, Entity.TRIP))
    drawn = [{key: _plain(one[key]) for key in keys if key in one} for one in trips]
    return {"name": str(number), **rest, "trips": drawn}


def _plain(given: object) -> object:
    """Return a value as JSON, with TOML's times of day as text."""
    return given.isoformat("auto") if isinstance(given, time) else given
