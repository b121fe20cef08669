"""The addresses of the map: its places and zones, its floor plan, and the ways that drones take on it."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING

from ..map.drawn import StaleMap
from ..map.pictures import LARGEST, PICTURES
from .addresses import Addresses, check_type, json_body, nothing_else, taken
from .http import Reply, Request, json_reply
from .strict_json import asked_number

if TYPE_CHECKING:
    from ..map.drawn import DrawnMap
    from ..map.ways import DrawnWays

IMAGE = "/api/map/image"
LARGEST_BODIES = {IMAGE: LARGEST}
"""The largest bodies in bytes, by the addresses at which they are larger than others."""


def map_addresses(drawn: DrawnMap, ways: DrawnWays) -> Addresses:
    """Return the addresses of a map."""

    async def show(_: Request) -> Reply:
        return json_reply(200, drawn.data())

    async def change(request: Request) -> Reply:
        given = await json_body(request)
        revision = taken(given, "revision", int)
        return await _changed(drawn, lambda: drawn.change(revision, given))

    async def take_picture(request: Request) -> Reply:
        check_type(request, *dict.fromkeys(PICTURES.values()))
        revision, name = asked_number(request.query, "revision"), request.query.get("name", "")
        content = await request.read()
        return await _changed(drawn, lambda: drawn.take_picture(revision, name, content))

    async def find_ways(request: Request) -> Reply:
        given = await json_body(request)
        pairs = given.pop("ways", None)
        nothing_else(given)
        return json_reply(200, await ways.ways(pairs))

    async def sweep(request: Request) -> Reply:
        return json_reply(200, await ways.sweep(await json_body(request)))

    return {
        "/api/map": {"GET": show, "PUT": change},
        IMAGE: {"PUT": take_picture},
        "/api/ways": {"POST": find_ways},
        "/api/plan/sweep": {"POST": sweep},
    }


async def _changed(drawn: DrawnMap, change: Callable[[], Coroutine[object, object, None]]) -> Reply:
    """Change the map; a page with an old one gets the newest."""
    try:
        await change()
    except StaleMap:
        return json_reply(409, drawn.data())
    return json_reply(200, drawn.data())
