"""Serving an `Api` with uvicorn in the station's own loop, and limiting its connections."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Callable
from contextlib import nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from ...shared.connections import LimitedConnection
from .guard import Guard, bearer, role_by

if TYPE_CHECKING:
    from uvicorn._types import HTTPScope

    from .api import Api


_LARGEST_MESSAGE = 64 * 1024
_LARGEST_HEAD = 16 * 1024
"""The largest WebSocket message and head of a request, in bytes."""


async def serve(api: Api, listener: socket.socket, ready: Callable[[], object]) -> None:
    """Serve on a listening socket until cancelled; `ready` is called when it serves."""
    server = _server(api)
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


def _server(api: Api) -> uvicorn.Server:
    """Return a server without handlers of signals, logs and proxies."""
    config = uvicorn.Config(
        api,
        # it makes a protocol, and uvicorn's hints know but the class itself
        http=partial(_Connection, api.guard),  # type: ignore[arg-type]
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
