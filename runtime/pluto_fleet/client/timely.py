"""An answer that comes in time, however slowly a server sends what it sends."""

from __future__ import annotations

import io
import socket
import time
from http.client import HTTPResponse
from typing import Any

SLOWEST = 10_000
"""Bytes a second that come in the mean at least, once the time-out is over."""


class TimelyResponse(HTTPResponse):
    """Raises `TimeoutError` when a server is slower than that, its headers included."""

    def __init__(self, sock: socket.socket, *given: Any, **more: Any) -> None:
        super().__init__(sock, *given, **more)
        self.fp.close()
        self.fp = io.BufferedReader(_Timely(sock))


class _Timely(io.RawIOBase):
    """Reads a socket, whose own time-out is that of the whole."""

    def __init__(self, sock: socket.socket) -> None:
        self._socket = sock
        self._file = sock.makefile("rb", buffering=0)
        self._until = time.monotonic() + (sock.gettimeout() or 0.0)

    def readable(self) -> bool:
        """It is to be read."""
        return True

    def readinto(self, buffer: Any) -> int | None:
        """Read what has come."""
        rest = self._until - time.monotonic()
        try:
            if rest <= 0:
                raise TimeoutError
            self._socket.settimeout(rest)
            count = self._file.readinto(buffer)
        except TimeoutError:
            raise TimeoutError("it answers too slowly") from None
        self._until += (count or 0) / SLOWEST
        return count

    def close(self) -> None:
        """Let go of the socket."""
        self._file.close()
        super().close()
