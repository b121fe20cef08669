"""The addresses by which changes of the plan are taken back, and plans are kept under names."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING

from ...shared.domain.errors import BadInput
from ..plan.history import Step
from ..plan.plan import Stale
from .addresses import Addresses, Handler, json_body, me, nothing_else, taken
from .http import Reply, Request, json_reply, said

if TYPE_CHECKING:
    from ..plan.library import PlanLibrary
    from ..plan.plan import MissionPlan


def plan_addresses(plan: MissionPlan, library: PlanLibrary) -> Addresses:
    """Return the addresses of a plan's history, and of a library."""

    def step(kind: Step) -> Handler:
        async def take(request: Request) -> Reply:
            given = await json_body(request)
            revision, by = taken(given, "revision", int), me(request)
            nothing_else(given)

            async def change() -> None:
                plan.step_back(revision, by, kind)

            return await _edited(plan, change)

        return take

    async def changes(request: Request) -> Reply:
        by = me(request)
        can = {kind.value: plan.history.can(by, kind) for kind in (Step.UNDO, Step.REDO)}
        return json_reply(200, {"changes": plan.history.changes, **can})

    one_at_a_time = asyncio.Lock()

    async def kept(change: Callable[[], None] | None = None) -> Reply:
        """Change the library, and answer with all that it has then."""
        async with one_at_a_time:
            try:
                if change is not None:
                    await asyncio.to_thread(change)
                plans = await asyncio.to_thread(library.plans)
            except BadInput as error:
                return said(409, str(error))
            return json_reply(200, {"plans": plans, "trash": library.trash()})

    async def listed(_: Request) -> Reply:
        return await kept()

    async def save(request: Request) -> Reply:
        given = await json_body(request)
        by, template = str(taken(given, "by", str, "")), taken(given, "template", bool, False)
        replace = taken(given, "replace", bool, False)
        nothing_else(given)
        name, text = request.query.get("name", ""), plan.export_toml()
        return await kept(
            lambda: library.save(
                name, text, by, template=template is True, replace=replace is True
            ),
        )

    async def open_one(request: Request) -> Reply:
        given = await json_body(request)
        name, revision = str(taken(given, "name", str)), taken(given, "revision", int)
        adds, by = taken(given, "add", bool, False), me(request)
        nothing_else(given)

        async def change() -> None:
            text = await asyncio.to_thread(library.text, name)
            shapes, _ = await asyncio.to_thread(plan.saved, text, name)
            (plan.add if adds else plan.take)(shapes, revision, by)

        return await _edited(plan, change)

    async def delete(request: Request) -> Reply:
        name = request.query.get("name", "")
        return await kept(lambda: library.delete(name))

    async def restore(request: Request) -> Reply:
        given = await json_body(request)
        id = str(taken(given, "id", str))
        nothing_else(given)
        return await kept(lambda: library.restore(id))

    return {
        "/api/plan/undo": {"POST": step(Step.UNDO)},
        "/api/plan/redo": {"POST": step(Step.REDO)},
        "/api/plan/changes": {"GET": changes},
        "/api/plans": {"GET": listed, "PUT": save, "DELETE": delete},
        "/api/plans/open": {"POST": open_one},
        "/api/plans/restore": {"POST": restore},
    }


async def _edited(
    plan: MissionPlan, change: Callable[[], Coroutine[object, object, None]]
) -> Reply:
    """Change the plan; a page with an old one gets the newest."""
    status = 200
    try:
        await change()
    except Stale:
        status = 409
    except BadInput as error:
        return said(409, str(error))
    await plan.examined()
    return json_reply(status, plan.data())
