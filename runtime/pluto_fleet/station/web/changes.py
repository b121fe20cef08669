"""The handlers of commands, and of edits of the plan; each is logged with its outcome."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping

from ...files.reading import decoded
from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, printable
from ..commands import Malformed
from ..plan.plan import Stale
from .given import nothing_else
from .http import Reply, json_reply, said
from .reads import MISSIONS_FILE
from .served import Asked
from .strict_json import asked_number

_LONGEST_ID = 64
_LONGEST_NAME = 80


async def command(asked: Asked) -> Reply:
    """Carry out the command that the address names."""
    given = dict(asked.given)
    id = given.pop("id", None)
    if not isinstance(id, str) or not 0 < len(id) <= _LONGEST_ID:
        raise Malformed(f"a command needs an id: a text of at most {_LONGEST_ID} characters")
    name = asked.request.path.removeprefix("/api/")
    try:
        status, told = 200, await asked.station.command(name, id, given, asked.request.who)
    except Malformed:
        raise
    except BadInput as error:
        status, told = 409, str(error)
    asked.audit.done(asked.request, {"id": id, **given}, status, told)
    return said(status, told)


async def replace_plan(asked: Asked) -> Reply:
    """Replace the plan's missions."""
    given = dict(asked.given)
    revision, missions = _whole(given, "revision"), given.pop("missions", None)
    nothing_else(given)
    return await _edited(asked, asked.station.edit(revision, missions))


async def import_plan(asked: Asked) -> Reply:
    """Replace the plan's missions by those of a file."""
    query, plan = asked.request.query, asked.station.plan
    revision = asked_number(query, "revision")
    file = _file(query)

    async def take() -> None:
        await plan.import_file(decoded(asked.body, file), revision, file)

    return await _edited(asked, take())


async def add_example(asked: Asked) -> Reply:
    """Add an example to the plan."""
    given = dict(asked.given)
    revision = _whole(given, "revision")
    nothing_else(given)
    edit = _at_once(lambda: asked.station.plan.example(revision))
    return await _edited(asked, edit, impossible=409)


async def _at_once(edit: Callable[[], None]) -> None:
    edit()


async def _edited(
    asked: Asked, edit: Coroutine[None, None, None], *, impossible: int = 400
) -> Reply:
    """Change the plan; a page with an old revision gets the newest one."""
    plan = asked.station.plan
    try:
        await edit
        status = 200
    except Stale:
        status = 409
    except BadInput as error:
        asked.audit.done(asked.request, {}, impossible, str(error))
        return said(impossible, str(error))
    await plan.examined()
    data = plan.data()
    asked.audit.done(asked.request, {"revision": data.get("revision")}, status, "")
    return json_reply(status, data)


def _whole(given: dict[str, object], name: str) -> int:
    value = given.pop(name, None)
    if not isinstance(value, int) or isinstance(value, bool):
        raise Malformed(f"{name} must be a whole number")
    return value


def _file(query: Mapping[str, str]) -> str:
    """Return an untrusted file name, sanitized for messages."""
    return cut_off(printable(query.get("file", "").strip()), _LONGEST_NAME) or MISSIONS_FILE
