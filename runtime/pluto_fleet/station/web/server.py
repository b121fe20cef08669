"""Serving an `Api` with uvicorn in the station's own loop, and limiting its connections.

An idle connection makes room for others: else a client that opens many could lock out the one that sends a Stop.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator, Mapping
from contextlib import aclosing, contextmanager, nullcontext, suppress
from functools import partial
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qsl

import uvicorn
from starlette.requests import ClientDisconnect
from starlette.requests import Request as StarletteRequest
from starlette.responses import FileResponse, Response
from starlette.websockets import WebSocket, WebSocketDisconnect
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from ...shared.connections import LimitedConnection
from . import refusals
from .guard import Guard, bearer, role_by
from .http import Closed, Reply, Request
from .refusals import Refused

if TYPE_CHECKING:
    import socket

    from starlette.types import ASGIApp, Receive, Scope, Send
    from uvicorn._types import HTTPScope

    from .api import Api

_LARGEST_MESSAGE = 64 * 1024
_LARGEST_HEAD = 16 * 1024
"""The largest WebSocket message and head of a request, in bytes."""
BODY_WITHIN = 10.0
BYTES_A_SECOND = 512 * 1024
"""The time-out of a body in seconds, and the rate that lengthens it for large ones."""
_FIELDS = 16
_LONGEST_REASON = 120
"""The longest reason in a close frame, in bytes."""

_GONE = (ClientDisconnect, WebSocketDisconnect, RuntimeError, OSError)
"""The exceptions of a closed connection."""


async def serve(api: Api, listener: socket.socket, ready: Callable[[], object]) -> None:
    """Serve on a listening socket until cancelled; `ready` is called when it serves."""

    async def application(scope: Scope, receive: Receive, send: Send) -> None:
        request = _request(scope, receive)
        if scope["type"] == "websocket":
            await api.live(StarletteSocket(WebSocket(scope, receive, send)), request)
            return
        reply = await api.answer(request)
        headers = {"Content-Type": reply.type, **dict(reply.headers)}
        response = _response(reply, headers)
        try:
            with suppress(*_GONE):  # the client has disconnected
                await response(scope, receive, send)
        finally:
            if reply.file is not None:
                reply.file.unlink(missing_ok=True)

    server = _server(application, api.guard)
    serving = asyncio.create_task(server.serve([listener]))
    try:
        while not server.started and not serving.done():
            await asyncio.sleep(0)
        if not serving.done():
            ready()
        await asyncio.wait([serving])
    finally:
        api.end()
        server.should_exit = True
        await serving


def _response(reply: Reply, headers: dict[str, str]) -> Response:
    if reply.file is not None:
        return FileResponse(reply.file, reply.status, headers)
    return Response(reply.body, reply.status, headers)


def _server(application: ASGIApp, guard: Guard) -> uvicorn.Server:
    """Return a server without handlers of signals, logs and proxies."""
    config = uvicorn.Config(
        application,
        # it makes a protocol, and uvicorn's hints know but the class itself
        http=partial(_Connection, guard),  # type: ignore[arg-type]
        ws=WebSocketsSansIOProtocol,
        lifespan="off",
        workers=1,
        log_config=None,
        log_level="critical",
        access_log=False,
        proxy_headers=False,
        server_header=False,
        ws_max_size=_LARGEST_MESSAGE,
        ws_per_message_deflate=False,
        h11_max_incomplete_event_size=_LARGEST_HEAD,
        timeout_graceful_shutdown=1,
    )
    server = uvicorn.Server(config)
    vars(server)["capture_signals"] = nullcontext  # Ctrl-C is handled by the flight
    return server


class _Connection(LimitedConnection, H11Protocol):
    """An HTTP connection."""

    def __init__(self, guard: Guard, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self._guard = guard

    # uvicorn itself narrows the type of asyncio's argument
    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Register it, and make room for it."""
        super().connection_made(transport)
        self.take_in()

    @property
    def has_token(self) -> bool:
        """Whether its latest request had a token, or none is needed."""
        scope: HTTPScope | None = self.scope
        headers = [] if scope is None else [*scope["headers"]]
        token = next((value for name, value in headers if name == b"authorization"), b"")
        return role_by(self._guard, bearer(token.decode("latin-1"))) is not None


@contextmanager
def _closed_where_gone() -> Iterator[None]:
    try:
        yield
    except _GONE:
        raise Closed from None


class StarletteSocket:
    """A page's WebSocket."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket

    async def open(self) -> None:
        """Take the connection."""
        with _closed_where_gone():
            await self._socket.accept()

    async def refuse(self) -> None:
        """Refuse the connection: the server answers 403, which is all that a browser tells its page."""
        await self.close(1008, "")

    async def receive(self) -> str:
        """Return the next message; empty for one that is not text."""
        with _closed_where_gone():
            message = await self._socket.receive()
        if message["type"] == "websocket.disconnect":
            raise Closed
        text = message.get("text")
        return text if isinstance(text, str) else ""

    async def send(self, text: str) -> None:
        """Send this, and wait while it is not read."""
        with _closed_where_gone():
            await self._socket.send_text(text)

    async def close(self, code: int, why: str) -> None:
        """Hang up."""
        reason = why.encode()[:_LONGEST_REASON].decode(errors="ignore")
        with _closed_where_gone():
            await self._socket.close(code, reason)


def _request(scope: Scope, receive: Receive) -> Request:
    """Return the request, whose body is not read yet."""
    headers = _headers(scope)
    return Request(
        method=scope.get("method", "GET"),
        path=scope["path"],
        query=_query(scope),
        headers=headers,
        read=lambda most: _body(most, headers, scope, receive),
        gone=lambda: _gone(receive),
        client=_host(scope.get("client")),
        local=_host(scope.get("server")),
    )


def _headers(scope: Scope) -> dict[str, str]:
    """Return the headers; repeated ones are joined, which makes them invalid."""
    found: dict[str, str] = {}
    for name, value in scope["headers"]:
        key, text = name.decode("latin-1").lower(), value.decode("latin-1")
        found[key] = f"{found[key]}, {text}" if key in found else text
    return found


def _query(scope: Scope) -> dict[str, str]:
    text = scope["query_string"].decode("latin-1")
    try:
        return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=_FIELDS))
    except ValueError:
        return {}


def _host(end: object) -> str:
    return str(end[0]) if isinstance(end, (tuple, list)) and end else ""


async def _gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


async def _body(most: int, headers: Mapping[str, str], scope: Scope, receive: Receive) -> bytes:
    """Read a body to its end; raise `Refused` if it is too long."""
    length = headers.get("content-length", "0")
    if not length.isdecimal() or len(length) > 12 or int(length) > most:
        raise Refused(refusals.too_long(most))
    body = bytearray()
    try:
        async with (
            asyncio.timeout(max(BODY_WITHIN, most / BYTES_A_SECOND)),
            aclosing(StarletteRequest(scope, receive).stream()) as stream,
        ):
            async for chunk in stream:
                body += chunk
                if len(body) > most:
                    raise Refused(refusals.too_long(most))
    except TimeoutError:
        raise Refused(refusals.TOO_SLOW) from None
    except _GONE:
        raise Refused(refusals.CUT_OFF) from None
    return bytes(body)
