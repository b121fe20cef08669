"""The handlers of the map: its places and zones, its floor plan, and the ways that drones take on it."""

from __future__ import annotations

from collections.abc import Awaitable, Callable

from ...shared.domain.errors import BadInput
from ..map.drawn import StaleMap
from .given import changed, nothing_else, taken
from .http import Reply, json_reply, said
from .served import Asked
from .strict_json import asked_number


async def map_data(asked: Asked) -> Reply:
    """Return the map."""
    return json_reply(200, asked.station.map.data())


async def change_map(asked: Asked) -> Reply:
    """Take what was drawn on the map; what is not sent stays."""
    given, drawn = dict(asked.given), asked.station.map
    revision = taken(given, "revision", int)
    return await _changed(asked, lambda: drawn.change(revision, given))


async def take_floor_plan(asked: Asked) -> Reply:
    """Take a picture as the floor plan."""
    query, drawn = asked.request.query, asked.station.map
    revision, name = asked_number(query, "revision"), query.get("name", "")
    return await _changed(asked, lambda: drawn.take_picture(revision, name, asked.body))


async def find_ways(asked: Asked) -> Reply:
    """Return the ways between pairs of places."""
    given = dict(asked.given)
    pairs = given.pop("ways", None)
    nothing_else(given)
    try:
        return json_reply(200, await asked.station.ways.ways(pairs))
    except BadInput as error:
        return said(400, str(error))


async def sweep_area(asked: Asked) -> Reply:
    """Return the targets of an area's trips."""
    try:
        return json_reply(200, await asked.station.ways.sweep(dict(asked.given)))
    except BadInput as error:
        return said(400, str(error))


async def _changed(asked: Asked, change: Callable[[], Awaitable[object]]) -> Reply:
    async def newest() -> object:
        return asked.station.map.data()

    return await changed(asked, change, newest, StaleMap, impossible=400)
