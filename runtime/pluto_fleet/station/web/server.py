"""Serving an `Api` with uvicorn in the station's own loop: where it listens, and limiting its connections."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Callable
from contextlib import closing, nullcontext
from errno import EACCES, EADDRINUSE, EADDRNOTAVAIL
from functools import partial
from ipaddress import ip_address
from typing import TYPE_CHECKING, Any

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from ...process.forked import not_for_children
from ...shared.connections import LimitedConnection
from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from .guard import Guard, bearer, role_by

if TYPE_CHECKING:
    from uvicorn._types import HTTPScope

    from .api import Api


_BACKLOG = 128
_PORTS = 65536
_ELSEWHERE = ("192.0.2.1", 9)
"""An unassigned address: the route to it reveals our own address."""


def listening(host: str, port: int) -> socket.socket:
    """Return a listening socket; port 0 is any free one."""
    if not 0 <= port < _PORTS:
        raise BadInput(f"--port {port}: a port is a number from 0 to {_PORTS - 1}")
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        # not `create_server`: without its protocol asyncio leaves Nagle's algorithm on, 40 ms an answer
        listener = socket.socket(family, kind, protocol)
    except (OSError, ValueError):  # ValueError: an invalid host name
        raise BadInput(f"--host {quoted(host)}: there is no such address") from None
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen(_BACKLOG)
    except OSError as error:
        listener.close()
        raise BadInput(_why(error, host, port)) from None
    listener.setblocking(False)
    not_for_children(listener.fileno())
    return listener


def port_of(listener: socket.socket) -> int:
    """Return the port of a socket."""
    return int(listener.getsockname()[1])


def address(guard: Guard, token: str | None) -> str:
    """Return the address to open, with a token if there is one."""
    secret = f"#token={token}" if token is not None else ""
    return f"http://{_name(guard)}/{secret}"


def _name(guard: Guard) -> str:
    host = _own() if _is_every(guard.host) else guard.host
    return f"[{host}]:{guard.port}" if ":" in host else f"{host}:{guard.port}"


def _is_every(host: str) -> bool:
    try:
        return ip_address(host).is_unspecified
    except ValueError:
        return False


def _own() -> str:
    """Return this machine's address in the network; nothing is sent for that."""
    with closing(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) as way:
        try:
            way.connect(_ELSEWHERE)
            return str(way.getsockname()[0])
        except OSError:
            return "127.0.0.1"


def _why(error: OSError, host: str, port: int) -> str:
    known = {
        EADDRINUSE: f"port {port} is taken, perhaps by another station:"
        " end that, or choose another port with --port (0 takes any that is free)",
        EACCES: f"port {port} needs special rights: choose one above 1023 with --port",
        EADDRNOTAVAIL: f"--host {quoted(host)}: this machine has no such address",
    }
    return known.get(error.errno or 0, f"cannot listen at {quoted(host)}, port {port}: {error}")


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
