"""What is used of Starlette and uvicorn, and nothing else of them."""

from __future__ import annotations

from collections.abc import (
    AsyncGenerator,
    Awaitable,
    Callable,
    Mapping,
    MutableMapping,
    Sequence,
)
from contextlib import nullcontext
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Protocol

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import in_shell

from .connections import Crowd
from .http import Reply

if TYPE_CHECKING:
    import socket

_LARGEST_MESSAGE = 64 * 1024
_LARGEST_HEAD = 16 * 1024
"""Bytes of a message on a WebSocket, and of a request without its body."""

Scope = MutableMapping[str, object]
Message = MutableMapping[str, object]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Scope, Receive, Send], Awaitable[None]]


class Stream(Protocol):
    """A request, of which only the body is wanted."""

    def stream(self) -> AsyncGenerator[bytes, None]:
        """Return its parts as they come."""


class Response(Protocol):
    """An answer that can be sent."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it."""


class MakesResponse(Protocol):
    """The class of answers."""

    def __call__(self, content: bytes, *, status_code: int, headers: Mapping[str, str]) -> Response:
        """Make one."""


class WebSocket(Protocol):
    """A connection that stays."""

    async def accept(self) -> None:
        """Take it."""

    async def receive(self) -> Message:
        """Return what comes next."""

    async def send_text(self, data: str) -> None:
        """Send a text."""

    async def close(self, code: int, reason: str) -> None:
        """End it, or take it not."""


class Server(Protocol):
    """The server that runs in our loop."""

    started: bool
    should_exit: bool
    capture_signals: Callable[[], object]

    async def serve(self, sockets: Sequence[socket.socket]) -> None:
        """Serve until it should exit."""


class MakesStream(Protocol):
    """The class of requests."""

    def __call__(self, scope: Scope, receive: Receive) -> Stream:
        """Make one."""


class MakesWebSocket(Protocol):
    """The class of connections that stay."""

    def __call__(self, scope: Scope, receive: Receive, send: Send) -> WebSocket:
        """Make one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Borrowed:
    """All of it."""

    request: MakesStream
    response: MakesResponse
    websocket: MakesWebSocket
    serving: Callable[[Application], Server]
    gone: tuple[type[Exception], ...]
    """What is raised where the other side is no longer there."""

    def answer(self, reply: Reply) -> Response:
        """Return an answer of ours as one that can be sent."""
        headers = {"Content-Type": reply.type, **dict(reply.headers)}
        return self.response(reply.body, status_code=reply.status, headers=headers)


def borrowed(app: str) -> Borrowed:
    """Return what comes with the extra `station`, or say how to come by it."""
    try:
        requests = import_module("starlette.requests")
        responses = import_module("starlette.responses")
        websockets = import_module("starlette.websockets")
        import_module("uvicorn.protocols.websockets.websockets_sansio_impl")
    except ImportError:
        package = app.rstrip("_")  # no package's name ends so
        raise BadInput(
            "serve needs a web server, the extra `station` of this package:"
            f" pip install {in_shell(f'{package}[station]')}"
        ) from None
    return Borrowed(
        request=requests.Request,
        response=responses.Response,
        websocket=websockets.WebSocket,
        serving=_serving,
        gone=(requests.ClientDisconnect, websockets.WebSocketDisconnect, RuntimeError, OSError),
    )


def _serving(application: Application) -> Server:
    """Return a server that leaves signals, logs and proxies alone."""
    uvicorn = import_module("uvicorn")
    connection = import_module("uvicorn.protocols.http.h11_impl").H11Protocol
    starlette = import_module("starlette.applications").Starlette
    mount = import_module("starlette.routing").Mount
    routed = starlette(routes=[mount("/", app=application)])
    routed.router.default = application  # a path that begins with no slash
    config = uvicorn.Config(
        routed,
        http=Crowd(connection),
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
    server: Server = uvicorn.Server(config)
    server.capture_signals = nullcontext  # Ctrl-C is for those who fly
    return server
