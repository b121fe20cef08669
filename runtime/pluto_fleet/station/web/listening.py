"""The listening socket of the station, and the address to open."""

from __future__ import annotations

import socket
from contextlib import closing
from errno import EACCES, EADDRINUSE, EADDRNOTAVAIL
from ipaddress import ip_address

from ...process.forked import not_for_children
from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from .guard import Guard

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
