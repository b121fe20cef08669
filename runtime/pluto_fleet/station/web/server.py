"""Between the web server and the station's own requests and answers. Nothing is decided here."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import aclosing, suppress
from typing import TYPE_CHECKING, cast
from urllib.parse import parse_qsl

from . import refusals
from .borrowed import Borrowed, borrowed
from .http import Request
from .refusals import Refused
from .socket_line import SocketLine

if TYPE_CHECKING:
    import socket

    from .api import Api
    from .borrowed import Receive, Scope, Send

_LARGEST_BODY = 1024 * 1024
_BODY_WITHIN = 10.0
_FIELDS = 16


async def serve(api: Api, listener: socket.socket, app: str, ready: Callable[[], object]) -> None:
    """Serve on a socket that listens until cancelled; be told when pages can be asked for."""
    parts = borrowed(app)

    async def application(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            line = SocketLine(parts, scope, receive, send)
            await api.live(line, _request(parts, scope, receive))
            return
        reply = await api.answer(_request(parts, scope, receive))
        with suppress(*parts.gone):  # nobody waits for it any more
            await parts.answer(reply)(scope, receive, send)

    server = parts.serving(application)
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


def _request(parts: Borrowed, scope: Scope, receive: Receive) -> Request:
    """Return what is asked, with a body that is yet to be read."""
    headers = _headers(scope)
    return Request(
        method=str(scope.get("method", "GET")),
        path=str(scope["path"]),
        query=_query(scope),
        headers=headers,
        read=lambda: _body(parts, headers, scope, receive),
        client=_host(scope.get("client")),
        local=_host(scope.get("server")),
    )


def _headers(scope: Scope) -> dict[str, str]:
    """Return the headers; one that comes twice says both, and so nothing that is wanted."""
    found: dict[str, str] = {}
    for name, value in cast("list[tuple[bytes, bytes]]", scope["headers"]):
        key, text = name.decode("latin-1").lower(), value.decode("latin-1")
        found[key] = f"{found[key]}, {text}" if key in found else text
    return found


def _query(scope: Scope) -> dict[str, str]:
    text = cast("bytes", scope["query_string"]).decode("latin-1")
    try:
        return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=_FIELDS))
    except ValueError:
        return {}


def _host(end: object) -> str:
    return str(end[0]) if isinstance(end, (tuple, list)) and end else ""


async def _body(parts: Borrowed, headers: dict[str, str], scope: Scope, receive: Receive) -> bytes:
    """Read a body to its end, or no further than anybody needs."""
    length = headers.get("content-length", "0")
    if not length.isdecimal() or len(length) > 12 or int(length) > _LARGEST_BODY:
        raise Refused(refusals.too_long(_LARGEST_BODY))
    body = bytearray()
    try:
        async with (
            asyncio.timeout(_BODY_WITHIN),
            aclosing(parts.request(scope, receive).stream()) as stream,
        ):
            async for chunk in stream:
                body += chunk
                if len(body) > _LARGEST_BODY:
                    raise Refused(refusals.too_long(_LARGEST_BODY))
    except TimeoutError:
        raise Refused(refusals.too_slow()) from None
    except parts.gone:
        raise Refused(refusals.cut_off()) from None
    return bytes(body)
