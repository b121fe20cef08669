"""`plutoc edit`: serve one app to a browser until Ctrl-C."""

from __future__ import annotations

import asyncio
import errno
import socket
import webbrowser
from pathlib import Path

from plutoc.editor.guard import Guard
from plutoc.editor.server import serve
from plutoc.editor.session import Session
from plutoc.project.reading import UsageError, shown
from plutoc_runtime import output
from plutoc_runtime.domain.text import quoted

_PORTS = 65536


def run(path: Path, *, host: str, port: int, opens: bool) -> None:
    """Edit an app in a browser until interrupted; what was changed is saved then."""
    session = Session(path)
    listener = listening(host, port)
    guard = Guard(host=host, port=int(listener.getsockname()[1]))

    def ready() -> None:
        output.line(f"{shown(path)}: edit it at {guard.address}")
        output.tell("Ctrl-C ends it; every change is saved by itself")
        output.flush()
        if opens:
            webbrowser.open(guard.address)

    with listener:
        try:
            asyncio.run(serve(session, guard, listener.dup(), ready))
        except KeyboardInterrupt:
            if not session.lost:
                return
            output.tell(f"not ended: {session.lost}; Ctrl-C again ends it, and loses that")
            asyncio.run(serve(session, guard, listener, lambda: None))
        finally:
            if session.lost:
                output.tell(f"not saved: {session.lost}")


def listening(host: str, port: int) -> socket.socket:
    """Return a listening socket; port 0 is any that is free."""
    if not 0 <= port < _PORTS:
        raise UsageError(f"--port {port}: a port is a number from 0 to {_PORTS - 1}")
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        listener = socket.socket(family, kind, protocol)
    except (OSError, ValueError):  # ValueError: an invalid host name
        raise UsageError(f"--host {quoted(host)}: there is no such address") from None
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen()
    except OSError as error:
        listener.close()
        raise UsageError(_why(error, host, port)) from None
    listener.setblocking(False)
    return listener


def _why(error: OSError, host: str, port: int) -> str:
    match error.errno:
        case errno.EADDRINUSE:
            return (
                f"port {port} is taken: choose another one with --port (0 takes any that is free)"
            )
        case errno.EACCES:
            return f"port {port} needs special rights: choose one above 1023 with --port"
        case errno.EADDRNOTAVAIL:
            return f"--host {quoted(host)}: this machine has no such address"
        case _:
            return f"cannot listen at {quoted(host)}, port {port}: {error}"
