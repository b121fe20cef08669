"""The handlers that keep plans under names."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

from ..plan.plan import Stale
from .given import changed, nothing_else, taken
from .http import Reply, json_reply
from .served import Asked


async def saved_plans(asked: Asked) -> Reply:
    """Return all plans that are kept."""
    return json_reply(200, await _everything(asked))


async def save_plan(asked: Asked) -> Reply:
    """Keep the plan under a name."""
    given, library = dict(asked.given), asked.station.library
    by, template = str(taken(given, "by", str, "")), taken(given, "template", bool, False) is True
    replace = taken(given, "replace", bool, False) is True
    nothing_else(given)
    name, text = asked.request.query.get("name", ""), asked.station.plan.export_toml()
    return await _kept(
        asked, lambda: library.save(name, text, by, template=template, replace=replace)
    )


async def delete_plan(asked: Asked) -> Reply:
    """Put a plan into the trash."""
    name = asked.request.query.get("name", "")
    return await _kept(asked, lambda: asked.station.library.delete(name))


async def restore_plan(asked: Asked) -> Reply:
    """Take a plan out of the trash."""
    given = dict(asked.given)
    id = str(taken(given, "id", str))
    nothing_else(given)
    return await _kept(asked, lambda: asked.station.library.restore(id))


async def open_plan(asked: Asked) -> Reply:
    """Take a plan that was kept in place of what has not been started, or beside it."""
    given, plan = dict(asked.given), asked.station.plan
    name, revision = str(taken(given, "name", str)), taken(given, "revision", int)
    adds = taken(given, "add", bool, False) is True
    nothing_else(given)

    async def change() -> None:
        text = await asyncio.to_thread(asked.station.library.text, name)
        shapes, _ = await asyncio.to_thread(plan.saved, text, name)
        (plan.add if adds else plan.take_instead)(shapes, revision)

    return await _edited(asked, change)


async def _edited(asked: Asked, change: Callable[[], Awaitable[object]]) -> Reply:
    plan = asked.station.plan

    async def newest() -> object:
        await plan.examined()
        return plan.data()

    return await changed(asked, change, newest, Stale)


async def _kept(asked: Asked, change: Callable[[], None]) -> Reply:
    async def in_a_thread() -> None:
        async with asked.station.library.one_at_a_time:
            await asyncio.to_thread(change)

    return await changed(asked, in_a_thread, lambda: _everything(asked), Stale)


async def _everything(asked: Asked) -> object:
    library = asked.station.library
    async with library.one_at_a_time:
        return await asyncio.to_thread(library.everything)
