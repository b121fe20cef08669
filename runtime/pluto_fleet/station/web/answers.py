"""What each address answers, to those who may ask."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import cut_off, printable

from ..commands import NEEDS, Malformed
from ..plan.errors import Stale
from . import refusals
from .audit import Audit
from .behind import Plan, Station
from .http import Reply, Request, json_reply, text_reply
from .http import said as in_words
from .refusals import Refused
from .strict_json import parsed_object

ADDRESSES: Mapping[str, tuple[str, ...]] = {
    "/api/app": ("GET",),
    "/api/live": ("GET",),
    "/api/plan": ("GET", "PUT"),
    "/api/plan.toml": ("GET",),
    "/api/plan/import": ("POST",),
    "/api/plan/example": ("POST",),
    "/api/console.txt": ("GET",),
    "/api/results.json": ("GET",),
    **{f"/api/{command}": ("POST",) for command in NEEDS},
}
_LONGEST_ID = 64
_DIGITS = 15
_LONGEST_NAME = 80
_NAME = "missions.toml"
_JSON, _TOML = "application/json", "application/toml"


async def read(station: Station, path: str) -> Reply:
    """Answer somebody who only wants to know."""
    match path:
        case "/api/app":
            return json_reply(200, station.described)
        case "/api/plan":
            await station.plan.examined()
            return json_reply(200, station.plan.data())
        case "/api/plan.toml":
            try:
                return text_reply(station.plan.export_toml(), _NAME, _TOML)
            except BadInput as error:
                return in_words(409, str(error))
        case "/api/console.txt":
            return text_reply(station.console(), "console.txt")
        case _:
            results = json_reply(200, station.results())
            named = ("Content-Disposition", 'attachment; filename="results.json"')
            return Reply(status=200, body=results.body, headers=(named,))


async def change(station: Station, audit: Audit, request: Request) -> Reply:
    """Do what somebody commands, and note it, whatever comes of it."""
    wanted = _TOML if request.path == "/api/plan/import" else _JSON
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() != wanted:
        raise Refused(refusals.wrong_type(wanted))
    body = await request.read()
    plan = station.plan
    match request.path:
        case "/api/plan":
            given = parsed_object(body)
            revision, missions = _whole(given, "revision"), given.pop("missions", None)
            _nothing_else(given)
            edit = _at_once(lambda: plan.replace(revision, missions))
            return await _edited(plan, audit, request, edit)
        case "/api/plan/import":
            revision, text = asked_number(request.query, "revision"), _text(body)
            edit = plan.import_file(text, revision, _file(request.query))
            return await _edited(plan, audit, request, edit)
        case "/api/plan/example":
            given = parsed_object(body)
            revision = _whole(given, "revision")
            _nothing_else(given)
            edit = _at_once(lambda: plan.example(revision))
            return await _edited(plan, audit, request, edit)
        case path:
            given = parsed_object(body)
            return await _commanded(station, audit, request, path.removeprefix("/api/"), given)


async def _commanded(
    station: Station, audit: Audit, request: Request, name: str, given: dict[str, object]
) -> Reply:
    id = given.pop("id", None)
    if not isinstance(id, str) or not 0 < len(id) <= _LONGEST_ID:
        raise Malformed(f"a command needs an id: a text of at most {_LONGEST_ID} characters")
    try:
        status, said = 200, await station.command(name, id, given)
    except Malformed:
        raise
    except BadInput as error:
        status, said = 409, str(error)
    audit.done(request, {"id": id, **given}, status, said)
    return in_words(status, said)


async def _at_once(edit: Callable[[], None]) -> None:
    edit()


async def _edited(
    plan: Plan, audit: Audit, request: Request, edit: Coroutine[None, None, None]
) -> Reply:
    """Change the plan; who has seen an older one is given the newest."""
    try:
        await edit
        status = 200
    except Stale:
        status = 409
    except BadInput as error:
        status = 409 if request.path == "/api/plan/example" else 400
        audit.done(request, {}, status, str(error))
        return in_words(status, str(error))
    await plan.examined()
    data = plan.data()
    audit.done(request, {"revision": data.get("revision")}, status, "")
    return json_reply(status, data)


def asked_number(query: Mapping[str, str], name: str) -> int:
    """Return a whole number of an address: 0 where there is none."""
    text = query.get(name, "0")
    if not (text.isascii() and text.isdecimal() and len(text) <= _DIGITS):
        raise Malformed(f"{name} must be a whole number")
    return int(text)


def _whole(given: dict[str, object], name: str) -> int:
    value = given.pop(name, None)
    if not isinstance(value, int) or isinstance(value, bool):
        raise Malformed(f"{name} must be a whole number")
    return value


def _file(query: Mapping[str, str]) -> str:
    """Return the name of a file as it can be told: a stranger may have chosen it."""
    return cut_off(printable(query.get("file", "").strip()), _LONGEST_NAME) or _NAME


def _text(body: bytes) -> str:
    try:
        return body.decode("utf-8")
    except UnicodeDecodeError:
        raise Malformed("the file is not UTF-8") from None


def _nothing_else(given: Mapping[str, object]) -> None:
    if given:
        raise Malformed("what was sent has more in it than is known here")
