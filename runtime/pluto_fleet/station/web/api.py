"""The HTTP interface of a station, as a Starlette application: who is let in, and how many at once.

Every request passes the `Door`. Routes are made of the declared interface.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Iterator, Mapping
from contextlib import aclosing, contextmanager
from typing import TYPE_CHECKING

from starlette.applications import Starlette
from starlette.datastructures import MutableHeaders
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, HTTPConnection, Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute

from ...process.copies import Died
from ...shared.domain.errors import BadInput
from ..map.drawn import StaleMap
from ..map.pictures import Logo
from ..operation import JSON, SMALL_BODY, Operation
from ..plan.plan import Stale
from ..wire import Role
from ..wire_app import PlanData
from . import refusals
from .audit import Audit
from .guard import (
    Access,
    Guard,
    Rate,
    client_of,
    header,
    refusal,
    role_of,
    safe_headers,
)
from .handlers import HANDLERS, NEWEST, OPERATIONS, Asked, said
from .live import LIVE, LiveUpdates
from .refusals import Refusal, Refused
from .static import StaticFile, logo_file, pages, picture

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

    from ..station import Station

_COMMANDS_A_SECOND, _EDITS_A_SECOND, _READS_A_SECOND = 20.0, 20.0, 100.0
"""Rates per second for each client; edits of the plan do not count as commands."""
_MOST_UNDER_WAY = 64
"""The most concurrent requests, without Stops."""
_MOST_READING = 32
"""The most of them that read files of flights: these may be slow, and leave room for all others."""
_MOST_LARGE = 2
"""The most of them whose bodies may be large."""
_WRONG_TOKEN_WAITS = 0.5
"""Seconds after which a wrong token is refused."""
_MOST_WAITING = 32
"""The most delayed refusals; more are sent at once."""
BODY_WITHIN = 10.0
BYTES_A_SECOND = 512 * 1024
"""The time-out of a body in seconds, and the rate that lengthens it for large ones."""

Pause = Callable[[float], Awaitable[object]]


class Api(Starlette):
    """The HTTP interface of one station."""

    def __init__(
        self,
        station: Station,
        guard: Guard,
        audit: Audit,
        *,
        clock: Callable[[], float] = time.monotonic,
        pause: Pause = asyncio.sleep,
        logo: Logo | None = None,
    ) -> None:
        self.guard = guard
        self._station = station
        self._audit = audit
        self._places = _Places(clock)
        self._picture = picture(station.map.image)
        self._live = LiveUpdates(station, guard, audit, clock)
        self._handlers = {**HANDLERS, "live": self._live.poll}
        self._static = dict(pages())
        if logo is not None:
            self._static["/logo"] = logo_file(logo)
        by_path: dict[str, dict[str, Operation]] = {}
        for one in OPERATIONS.values():
            by_path.setdefault(one.path, {})[one.method] = one
        routes = [
            WebSocketRoute(LIVE, self._live.talk),
            Route("/map", self._floor_plan),
            *(self._route(path, methods) for path, methods in by_path.items()),
        ]
        door = Middleware(_Door, guard=guard, audit=audit, pause=pause)
        refused = {Refused: self._refused, HTTPException: self._not_there}
        super().__init__(routes=routes, middleware=[door], exception_handlers=refused)
        self.router.redirect_slashes = False
        self.router.default = self._page

    def end(self) -> None:
        """Close the connections of all pages."""
        self._live.end()

    async def _refused(self, request: Request, error: Exception) -> Response:
        assert isinstance(error, Refused)
        self._audit.refused(request, error.refusal.status, error.refusal.said)
        return refusal_reply(error.refusal)

    async def _not_there(self, request: Request, error: Exception) -> Response:
        """Answer where Starlette finds no route, or none of this method."""
        assert isinstance(error, HTTPException)
        methods = (error.headers or {}).get("Allow", "").split(", ")
        allowed = ", ".join(sorted({*methods} - {"HEAD"}))
        why = refusals.wrong_method(allowed) if allowed else refusals.NO_SUCH_PAGE
        return await self._refused(request, Refused(why))

    async def _page(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer with a page's file, at an address that nothing else has."""
        is_read = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        held = self._static.get(scope["path"]) if is_read else None
        if held is None:
            await self.router.not_found(scope, receive, send)
        else:
            await _file_reply(held, Request(scope))(scope, receive, send)

    async def _floor_plan(self, request: Request) -> Response:
        """Answer with the floor plan, read once: another one has another name."""
        if self._picture[0] != self._station.map.image:
            self._picture = picture(self._station.map.image)
        if self._picture[1] is None:
            raise Refused(refusals.NO_SUCH_PAGE)
        return _file_reply(self._picture[1], request)

    def _route(self, path: str, methods: Mapping[str, Operation]) -> Route:
        async def answer(request: Request) -> Response:
            operation = methods["GET" if request.method == "HEAD" else request.method]
            role = role_of(self.guard, request)
            if role is None or (operation.role == "fly" and role != "fly"):
                raise Refused(refusals.WATCHES)
            if operation.always or operation.path == LIVE:
                return await self._done(operation, request, role)
            with self._places.taken(operation, f"{role} {client_of(request)}"):
                return await self._done(operation, request, role)

        return Route(path, answer, methods=list(methods))

    async def _done(self, operation: Operation, request: Request, role: Role) -> Response:
        """Read what was sent, do what is asked, and note that in the audit."""
        body = b""
        try:
            given = operation.asked(request.query_params)
            given |= request.path_params
            if operation.body is not None or operation.takes:
                body = await _body(operation, request)
            if operation.body is not None:
                given |= operation.sent(body)
        except BadInput as error:
            raise Refused(refusals.malformed(str(error))) from None
        handler = self._handlers[operation.name]
        asked = Asked(
            station=self._station,
            request=request,
            operation=operation,
            role=role,
            given=given,
            body=body,
        )
        status = 200
        try:
            answer = await handler(asked, **{**operation.defaults, **given})
        except (Stale, StaleMap):
            status = 409
            answer = None
        except BadInput as error:
            status = operation.impossible
            answer = str(error)
        except Died:
            raise Refused(refusals.READER_ENDED) from None
        if not operation.reads:
            told = answer if isinstance(answer, str) else ""
            self._audit.done(request, _noted(operation, given), status, told)
        if isinstance(answer, str):
            return said(answer, status)
        if answer is None:
            answer = await NEWEST[operation.answers](asked)
            answer.status_code = status
        return answer


def _noted(operation: Operation, given: Mapping[str, object]) -> Mapping[str, object]:
    """Return what the audit has of a change: of the plan, not the plan itself."""
    whole = operation.stale is not PlanData
    return {name: value for name, value in given.items() if whole or name != "missions"}


def _file_reply(held: StaticFile, request: Request) -> Response:
    """Answer with a file, or 304 if the browser has it already."""
    headers = {
        "Content-Type": held.type,
        "ETag": held.mark,
        "Cache-Control": "no-cache",
        "Vary": "Accept-Encoding",
    }
    if held.mark in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    if held.packed is not None and "gzip" in request.headers.get("accept-encoding", ""):
        return Response(held.packed, headers={**headers, "Content-Encoding": "gzip"})
    return Response(held.plain, headers=headers)


def refusal_reply(why: Refusal) -> Response:
    """Answer with why a request is refused."""
    answer = said(why.said, why.status)
    answer.headers.update(why.headers)
    return answer


async def _body(operation: Operation, request: Request) -> bytes:
    """Read a body to its end; raise `Refused` if it is of another type, too long or too slow."""
    types = operation.takes or (JSON,)
    most = operation.most_bytes
    if header(request, "content-type").partition(";")[0].strip().lower() not in types:
        raise Refused(refusals.wrong_type(" or ".join(types)))
    length = header(request, "content-length") or "0"
    if not length.isdecimal() or len(length) > 12 or int(length) > most:
        raise Refused(refusals.too_long(most))
    body = bytearray()
    try:
        async with (
            asyncio.timeout(max(BODY_WITHIN, most / BYTES_A_SECOND)),
            aclosing(request.stream()) as stream,
        ):
            async for chunk in stream:
                body += chunk
                if len(body) > most:
                    raise Refused(refusals.too_long(most))
    except TimeoutError:
        raise Refused(refusals.TOO_SLOW) from None
    except ClientDisconnect:
        raise Refused(refusals.CUT_OFF) from None
    return bytes(body)


class _Places:
    """How many may ask at once, and how often each."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._commands = Rate(_COMMANDS_A_SECOND, clock)
        self._edits = Rate(_EDITS_A_SECOND, clock)
        self._reads = Rate(_READS_A_SECOND, clock)
        self._under_way = 0
        self._reading = 0
        self._large = 0

    @contextmanager
    def taken(self, operation: Operation, client: str) -> Iterator[None]:
        """Take a place while a request is answered; raise `Refused` where there is none."""
        rate = self._edits if operation.path.startswith("/api/plan") else self._commands
        if not (self._reads if operation.method == "GET" else rate).allows(client):
            raise Refused(refusals.TOO_MANY)
        reads = operation.reads_flights
        is_large = operation.most_bytes > SMALL_BODY
        if (
            self._under_way >= _MOST_UNDER_WAY
            or (reads and self._reading >= _MOST_READING)
            or (is_large and self._large >= _MOST_LARGE)
        ):
            raise Refused(refusals.TOO_BUSY)
        self._under_way += 1
        self._reading += reads
        self._large += is_large
        try:
            yield
        finally:
            self._under_way -= 1
            self._reading -= reads
            self._large -= is_large


class _Door:
    """Lets in who may ask, gives every answer its security headers, and tells no client of our mistakes."""

    def __init__(self, app: ASGIApp, guard: Guard, audit: Audit, pause: Pause) -> None:
        self._app = app
        self._guard = guard
        self._audit = audit
        self._pause = pause
        self._waiting = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        connection = HTTPConnection(scope)
        why = refusal(self._guard, connection, _access(scope))
        if scope["type"] == "websocket":
            if why is None:
                await self._app(scope, receive, send)
            else:
                self._audit.refused(connection, why.status, why.said)
                await send({"type": "websocket.close"})  # the server answers 403
            return
        begun = False

        async def with_headers(message: Message) -> None:
            nonlocal begun
            if message["type"] == "http.response.start":
                begun = True
                safe_headers(connection, MutableHeaders(scope=message))
            await send(message)

        try:
            if why is None:
                await self._app(scope, receive, with_headers)
                return
            if why.status == 401:
                await self._slow_down()
            self._audit.refused(connection, why.status, why.said)
        except ClientDisconnect:
            return
        except Exception as error:  # noqa: BLE001 - a bug fails one request alone
            self._audit.trouble(connection, error)
            why = refusals.OURS
        if not begun:
            await refusal_reply(why)(scope, receive, with_headers)

    async def _slow_down(self) -> None:
        """Delay the refusal of a wrong token, against guessing."""
        if self._waiting >= _MOST_WAITING:
            return
        self._waiting += 1
        try:
            await self._pause(_WRONG_TOKEN_WAITS)
        finally:
            self._waiting -= 1


def _access(scope: Scope) -> Access:
    if scope["type"] == "websocket":
        return Access.LIVE
    if scope["method"] not in ("GET", "HEAD"):
        return Access.COMMAND
    reads = scope["path"].startswith("/api/") or scope["path"] == "/map"
    return Access.READ if reads else Access.PAGE
