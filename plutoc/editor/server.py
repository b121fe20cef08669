"""The web server of the editor: the page, its files, and a socket for each client.

Connections are bounded in number, size and time, and a refused one has touched nothing.
"""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable, Mapping
from contextlib import nullcontext, suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import uvicorn
from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect
from uvicorn.protocols.http.h11_impl import H11Protocol

from plutoc.editor.guard import Guard, headers, is_ours, is_own_page, knows
from plutoc.editor.session import Client, Session
from plutoc.editor.static import PAGE, pages
from plutoc.foreign_code import ENDING, Terminated
from plutoc.source import LARGEST
from plutoc_runtime.connections import LimitedConnection

if TYPE_CHECKING:
    import socket

_LARGEST_HEAD = 16 * 1024
_LARGEST_MESSAGE = 8 * LARGEST
"""A text of the largest size, each character escaped as JSON may."""
MOST_CLIENTS = 32
_NO_TOKEN, _TOO_MANY, _GOING, _SLOW = 4401, 4429, 1012, 4408
_GONE = (WebSocketDisconnect, RuntimeError, OSError)
"""What sending to a connection that has ended raises."""


class Web:
    """The routes of one session."""

    def __init__(self, session: Session, guard: Guard) -> None:
        self._session, self._guard = session, guard
        self._on = 0
        self.application = Starlette(
            routes=[
                Route("/", self._page, methods=["GET"]),
                Route("/static/{path:path}", self._static, methods=["GET"]),
                WebSocketRoute("/ws", self._live),
            ],
            exception_handlers={404: _nothing, 405: _nothing},
        )

    async def _page(self, request: Request) -> Response:
        if not self._is_ours(request):
            return _said(403, "This editor does not go by that name: open the address it printed.")
        token = request.query_params.get("token")
        if token is not None:
            if not knows(self._guard, token):
                return _said(401, "That is not the token: open the address that was printed last.")
            reply: Response = RedirectResponse("/", 303, headers())
            reply.set_cookie(self._guard.cookie, token, httponly=True, samesite="strict", path="/")
            reply.headers["Cache-Control"] = "no-store"
            return reply
        found = pages().get(PAGE)
        if found is None:
            return _said(404, "This installation has no pages.")
        reply = Response(found.content, 200, headers(page=True), found.type)
        reply.headers["Cache-Control"] = "no-store"
        return reply

    async def _static(self, request: Request) -> Response:
        if not self._is_ours(request):
            return _said(403, "This editor does not go by that name: open the address it printed.")
        found = pages().get(request.path_params["path"])
        if found is None or found.type.startswith("text/html"):
            return _said(404, "There is nothing at this address.")
        kept = {"ETag": found.mark, "Cache-Control": "no-cache", **headers()}
        if found.mark in request.headers.get("if-none-match", ""):
            return Response(status_code=304, headers=kept)
        return Response(found.content, 200, kept, found.type)

    def knows(self, request: HTTPConnection) -> bool:
        """Return whether a request has the token."""
        token = request.cookies.get(self._guard.cookie, "") or _bearer(_headers(request))
        return knows(self._guard, token)

    def _is_ours(self, request: Request | WebSocket) -> bool:
        server = request.scope.get("server")
        return is_ours(self._guard, _headers(request), str(server[0]) if server else "")

    async def _live(self, socket: WebSocket) -> None:
        found = _headers(socket)
        if not (self._is_ours(socket) and is_own_page(found)):
            await socket.close(1008)  # the server answers 403, which is all that a page is told
            return
        if not self.knows(socket):
            await socket.accept()
            await socket.close(_NO_TOKEN, "open the address that was printed at the start")
            return
        if self._on >= MOST_CLIENTS:
            await socket.accept()
            await socket.close(_TOO_MANY, "too many pages are open")
            return
        self._on += 1
        try:
            await socket.accept()
            await self._talk(socket)
        finally:
            self._on -= 1

    async def _talk(self, socket: WebSocket) -> None:
        client = self._session.join()
        sending = asyncio.create_task(_send(client, socket))
        try:
            while True:
                message = await socket.receive()
                if message["type"] == "websocket.disconnect":
                    return
                await self._session.hear(client, message.get("text") or "")
        except _GONE:
            return
        finally:
            self._session.leave(client)
            sending.cancel()


async def _send(client: Client, socket: WebSocket) -> None:
    with suppress(*_GONE):
        while (text := await client.next()) is not None:
            await socket.send_text(text)
        await socket.close(_SLOW, "this page was too far behind: load it again")


def _headers(request: HTTPConnection) -> Mapping[str, str]:
    """Return the headers; one that is there twice is joined, which makes it wrong."""
    found: dict[str, str] = {}
    for name, value in request.headers.items():
        found[name] = f"{found[name]}, {value}" if name in found else value
    return found


def _bearer(found: Mapping[str, str]) -> str:
    kind, _, token = found.get("authorization", "").partition(" ")
    return token.strip() if kind.lower() == "bearer" else ""


def _said(status: int, text: str) -> Response:
    return Response(f"{text}\n", status, headers(), "text/plain; charset=utf-8")


async def _nothing(request: Request, error: Exception) -> Response:
    return _said(404, "There is nothing at this address.")


async def serve(
    session: Session, guard: Guard, listener: socket.socket, ready: Callable[[], object]
) -> None:
    """Serve on a listening socket until cancelled, and save what is not saved yet.

    A signal to end raises `Terminated` here, and not in whichever callback it meets.
    """
    told: list[int] = []
    serving = asyncio.create_task(_serve(session, guard, listener, ready))

    def end(number: int) -> None:
        told.append(number)
        serving.cancel()

    for one in ENDING:
        if signal.getsignal(one) != signal.SIG_IGN:  # as `nohup` has it
            with suppress(NotImplementedError):  # Windows sends none
                asyncio.get_running_loop().add_signal_handler(one, end, one)
    try:
        await serving
    except asyncio.CancelledError:
        if told:
            raise Terminated(told[0]) from None
        raise


async def _serve(
    session: Session, guard: Guard, listener: socket.socket, ready: Callable[[], object]
) -> None:
    server = _server(Web(session, guard))
    serving = asyncio.create_task(server.serve([listener]))
    at_work = [
        asyncio.create_task(session.keep_saving()),
        asyncio.create_task(session.keep_looking()),
    ]
    try:
        while not server.started and not serving.done():
            await asyncio.sleep(0)
        if not serving.done():
            ready()
        await asyncio.wait([serving, *at_work], return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in at_work:
            task.cancel()
        session.save()
        server.should_exit = True
        await serving
    for task in at_work:
        if task.done() and not task.cancelled():
            task.result()


class _Connection(LimitedConnection, H11Protocol):
    """An HTTP connection."""

    def __init__(self, knows: Callable[[HTTPConnection], bool], *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self._knows = knows

    # uvicorn itself narrows the type of asyncio's argument
    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Register it, and make room for it."""
        super().connection_made(transport)
        self.take_in()

    @property
    def has_token(self) -> bool:
        """Whether its latest request had the token."""
        scope: Any = self.scope
        return scope is not None and self._knows(HTTPConnection(scope))


def _server(web: Web) -> uvicorn.Server:
    """Return a server without handlers of signals, logs and proxies."""
    config = uvicorn.Config(
        web.application,
        # it makes a protocol, and uvicorn's hints know but the class itself
        http=partial(_Connection, web.knows),  # type: ignore[arg-type]
        ws="websockets-sansio",
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
    vars(server)["capture_signals"] = nullcontext  # Ctrl-C is ours
    return server
