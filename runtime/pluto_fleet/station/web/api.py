"""The HTTP interface of a station: access, rate limits, and the handler of each address."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, printable
from ..commands import NEEDS, Malformed
from ..plan.plan import Stale
from . import refusals
from .audit import Audit
from .further import DrawnStation, answered, browser
from .further_addresses import FURTHER
from .guard import Access, Guard, Rate, refusal, with_safe_headers
from .http import MISTAKES, PageSocket, Reply, Request, json_reply, text_reply
from .http import said as in_words
from .live import LIVE, LiveUpdates, UpdateSource
from .refusals import Refusal, Refused
from .static import StaticFile, file_reply, pages, picture
from .strict_json import asked_number, parsed_object

ADDRESSES: dict[str, tuple[str, ...]] = {
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
ALL_ADDRESSES = ADDRESSES | {path: tuple(methods) for path, methods in FURTHER.items()}
_LONGEST_ID = 64
_LONGEST_NAME = 80
_NAME = "missions.toml"
_JSON, _TOML = "application/json", "application/toml"


class ServedPlan(Protocol):
    """The plan; each change names the revision that it was made on, and raises `Stale` if that is old.

    `by` is the browser that makes it.
    """

    def data(self) -> Mapping[str, object]:
        """Return the plan with its known problems."""

    async def examined(self) -> None:
        """Wait until all its problems are known."""

    def replace(self, revision: int, missions: object, by: str) -> None:
        """Replace its missions."""

    async def import_file(self, text: str, revision: int, file: str, by: str) -> None:
        """Replace its missions by those of a file, whose name is used in messages."""

    def example(self, revision: int, by: str) -> None:
        """Add an example."""

    def export_toml(self) -> str:
        """Return it as a missions file."""


class ServedStation(UpdateSource, Protocol):
    """The station that is served."""

    @property
    def plan(self) -> ServedPlan:
        """The plan."""

    @property
    def image(self) -> Path | None:
        """The floor plan."""

    @property
    def described(self) -> Mapping[str, object]:
        """Return the constant data of app and fleet."""

    async def command(self, name: str, id: str, given: Mapping[str, object], /) -> str:
        """Carry out a command, unless it was carried out with this id before; raise `BadInput` if it cannot."""

    def console(self) -> str:
        """Return the console."""

    def results(self) -> list[object]:
        """Return the results."""


async def read(station: ServedStation, path: str) -> Reply:
    """Handle a request that changes nothing."""
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


async def change(station: ServedStation, audit: Audit, request: Request) -> Reply:
    """Carry out a command, and log it with its outcome."""
    wanted = _TOML if request.path == "/api/plan/import" else _JSON
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() != wanted:
        raise Refused(refusals.wrong_type(wanted))
    body = await request.read()
    plan = station.plan
    by = browser(request) if request.path.startswith("/api/plan") else ""
    match request.path:
        case "/api/plan":
            given = parsed_object(body)
            revision, missions = _whole(given, "revision"), given.pop("missions", None)
            _nothing_else(given)
            edit = _at_once(lambda: plan.replace(revision, missions, by))
        case "/api/plan/import":
            revision, text = asked_number(request.query, "revision"), _text(body)
            edit = plan.import_file(text, revision, _file(request.query), by)
        case "/api/plan/example":
            given = parsed_object(body)
            revision = _whole(given, "revision")
            _nothing_else(given)
            edit = _at_once(lambda: plan.example(revision, by))
        case path:
            given = parsed_object(body)
            return await _commanded(station, audit, request, path.removeprefix("/api/"), given)
    return await _edited(plan, audit, request, edit)


async def _commanded(
    station: ServedStation, audit: Audit, request: Request, name: str, given: dict[str, object]
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
    plan: ServedPlan, audit: Audit, request: Request, edit: Coroutine[None, None, None]
) -> Reply:
    """Change the plan; a page with an old revision gets the newest one."""
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


def _whole(given: dict[str, object], name: str) -> int:
    value = given.pop(name, None)
    if not isinstance(value, int) or isinstance(value, bool):
        raise Malformed(f"{name} must be a whole number")
    return value


def _file(query: Mapping[str, str]) -> str:
    """Return an untrusted file name, sanitized for messages."""
    return cut_off(printable(query.get("file", "").strip()), _LONGEST_NAME) or _NAME


def _text(body: bytes) -> str:
    try:
        return body.decode("utf-8")
    except UnicodeDecodeError:
        raise Malformed("the file is not UTF-8") from None


def _nothing_else(given: Mapping[str, object]) -> None:
    if given:
        raise Malformed("what was sent has more in it than is known here")


ALWAYS = ("/api/stop", "/api/cut-motors")
"""The commands that bring drones down, which are exempt from all limits."""

_COMMANDS_A_SECOND, _EDITS_A_SECOND, _READS_A_SECOND = 20.0, 20.0, 100.0
"""Rates per second for each client; edits of plan and map do not count as commands."""
_MOST_UNDER_WAY = 64
"""The most concurrent requests, without Stops."""
_WRONG_TOKEN_WAITS = 0.5
"""Seconds after which a wrong token is refused."""
_MOST_WAITING = 32
"""The most delayed refusals; more are sent at once."""

Pause = Callable[[float], Awaitable[object]]


class Api:
    """The HTTP interface of one station."""

    def __init__(
        self,
        station: ServedStation,
        guard: Guard,
        audit: Audit,
        drawn: DrawnStation | None = None,
        *,
        clock: Callable[[], float] = time.monotonic,
        pause: Pause = asyncio.sleep,
    ) -> None:
        """`drawn` is the station as further addresses need it; None: there are none."""
        self.guard = guard
        self._drawn = drawn
        self._station, self._audit, self._pause = station, audit, pause
        self._pages = pages()
        self._picture = picture(station.image)
        self._commands, self._edits = Rate(_COMMANDS_A_SECOND, clock), Rate(_EDITS_A_SECOND, clock)
        self._reads = Rate(_READS_A_SECOND, clock)
        self._live = LiveUpdates(station, guard, audit, clock)
        self._under_way = self._waiting = 0

    async def answer(self, request: Request) -> Reply:
        """Handle any request; errors reveal no internals."""
        if request.method == "HEAD":  # like GET; the server leaves the body out
            request = replace(request, method="GET")
        try:
            reply = await self._answer(request)
        except Refused as error:
            reply = self._refused(request, error.refusal)
        except Malformed as error:
            reply = self._refused(request, refusals.malformed(str(error)))
        except MISTAKES as error:
            self._audit.trouble(request, error)
            reply = refusals.OURS.reply
        return with_safe_headers(request, reply)

    async def live(self, page: PageSocket, request: Request) -> None:
        """Serve a page's WebSocket."""
        await self._live.talk(page, request)

    def end(self) -> None:
        """Close the connections of all pages."""
        self._live.end()

    def _refused(self, request: Request, why: Refusal) -> Reply:
        self._audit.refused(request, why.status, why.said)
        return why.reply

    async def _answer(self, request: Request) -> Reply:
        access = _asking(request)
        why = refusal(self.guard, request, access)
        if why is not None:
            if why.status == 401:
                await self._slow_down()
            raise Refused(why)
        if access is Access.PAGE and request.path in self._pages:
            return file_reply(self._pages[request.path], request)
        if request.path == "/map" and (held := self._floor_plan()) is not None:
            return file_reply(held, request)
        _route(request, ADDRESSES if self._drawn is None else ALL_ADDRESSES)
        if request.path == LIVE:
            return await self._live.poll(request)
        return await self._within_limits(request)

    def _floor_plan(self) -> StaticFile | None:
        """Return the floor plan, read once: another one has another name."""
        if self._picture[0] != self._station.image:
            self._picture = picture(self._station.image)
        return self._picture[1]

    async def _within_limits(self, request: Request) -> Reply:
        """Handle a request within the limits, from which commands that bring drones down are exempt."""
        if request.path in ALWAYS:
            return await change(self._station, self._audit, request)
        if not self._rate(request).allows(request.client):
            raise Refused(refusals.TOO_MANY)
        if self._under_way >= _MOST_UNDER_WAY:
            raise Refused(refusals.TOO_BUSY)
        self._under_way += 1
        try:
            if request.path in FURTHER and self._drawn is not None:
                address = FURTHER[request.path][request.method]
                return await answered(address, self._drawn, self._audit, request)
            if request.method == "GET":
                return await read(self._station, request.path)
            return await change(self._station, self._audit, request)
        finally:
            self._under_way -= 1

    def _rate(self, request: Request) -> Rate:
        if request.method == "GET":
            return self._reads
        is_edit = request.path in FURTHER or request.path.startswith("/api/plan")
        return self._edits if is_edit else self._commands

    async def _slow_down(self) -> None:
        """Delay the refusal of a wrong token, against guessing."""
        if self._waiting >= _MOST_WAITING:
            return
        self._waiting += 1
        try:
            await self._pause(_WRONG_TOKEN_WAITS)
        finally:
            self._waiting -= 1


def _asking(request: Request) -> Access:
    if request.method != "GET":
        return Access.COMMAND
    reads = request.path.startswith("/api/") or request.path == "/map"
    return Access.READ if reads else Access.PAGE


def _route(request: Request, addresses: Mapping[str, tuple[str, ...]]) -> None:
    """Raise `Refused` if there is nothing at an address, or not for this method."""
    allowed = addresses.get(request.path)
    if allowed is None:
        raise Refused(refusals.NO_SUCH_PAGE)
    if request.method not in allowed:
        raise Refused(refusals.wrong_method(", ".join(allowed)))
