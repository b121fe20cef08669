"""Requests, answers and WebSockets, independent of the web server.

So everything that makes decisions can be tested without one.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol
from urllib.parse import unquote

from ...shared.domain.text import cut_off, printable
from ..json_text import json_text

Read = Callable[[int], Awaitable[bytes]]
"""Reads a body to its end; raises `Refused` if it has more than so many bytes."""


async def nothing(most: int) -> bytes:
    """Read an empty body."""
    return b""


async def never() -> None:
    """Wait for ever."""
    await asyncio.get_running_loop().create_future()


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """A request; its body is read only after the access check."""

    method: str
    path: str
    query: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)  # lower-case names
    read: Read = nothing
    gone: Callable[[], Awaitable[None]] = never
    """Waits until the client has gone away; only after the body has been read."""
    client: str = ""  # the address of the connection; headers of proxies are ignored
    local: str = ""  # the address that it connected to

    @property
    def who(self) -> str:
        """The name that a person has given themselves, sanitized; it is never trusted."""
        name = unquote(self.headers.get(WHO, "")[:_LONGEST_HEADER], errors="replace")
        return cut_off(printable(name.strip()), LONGEST_WHO)


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """An answer."""

    status: int
    body: bytes = b""
    type: str = "application/json"
    headers: tuple[tuple[str, str], ...] = ()
    file: Path | None = None
    """A file to send instead of a body, and to delete then."""


WHO = "x-pluto-who"
"""The header with the name of a person, percent-encoded."""
LONGEST_WHO = 40
_LONGEST_HEADER = 1_000

MISTAKES: tuple[type[Exception], ...] = (Exception,)
"""The exceptions that are caught for bugs of the station: only one request fails."""


class Closed(Exception):
    """The connection has ended."""


class PageSocket(Protocol):
    """A WebSocket: first accepted or refused, then used. All methods but `close` may raise `Closed`."""

    async def open(self) -> None:
        """Accept the connection."""

    async def refuse(self) -> None:
        """Refuse the connection."""

    async def receive(self) -> str:
        """Return the next message."""

    async def send(self, text: str) -> None:
        """Send a message, and wait until it is read."""

    async def close(self, code: int, why: str) -> None:
        """Close the connection."""


def json_reply(status: int, data: object) -> Reply:
    """Answer with data as JSON; numbers that JSON lacks become texts."""
    return Reply(status=status, body=json_text(data).encode("ascii"))


def said(status: int, text: str) -> Reply:
    """Answer with a message."""
    return json_reply(status, {"said": text})


def text_reply(text: str, name: str, kind: str = "text/plain") -> Reply:
    """Answer with a text to be downloaded under this name."""
    return Reply(
        status=200,
        body=text.encode("utf-8", "replace"),
        type=f"{kind}; charset=utf-8",
        headers=(("Content-Disposition", f'attachment; filename="{name}"'),),
    )
