"""What a browser asks, what it is answered, and the line on which it stays connected.

Nothing here knows of a web server, so that all that decides can be tried without one.
"""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import Protocol

Read = Callable[[], Awaitable[bytes]]
"""Reads a body to its end, within limits: raises `Refused`."""


async def nothing() -> bytes:
    """Read a body that is not there."""
    return b""


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """A request; its body is read only once it is known that it may be made."""

    method: str
    path: str
    query: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)  # lower-case names
    read: Read = nothing
    client: str = ""  # the address that connected; what a proxy says of another is not believed
    local: str = ""  # the address that it connected to


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """What is answered."""

    status: int
    body: bytes = b""
    type: str = "application/json"
    headers: tuple[tuple[str, str], ...] = ()


MISTAKES: tuple[type[Exception], ...] = (Exception,)
"""What is caught of the station's own mistakes: one request fails, and no other."""


class Closed(Exception):
    """The connection has ended."""


class PageSocket(Protocol):
    """A WebSocket: first opened or refused, then talked on. All but `close` may raise `Closed`."""

    async def open(self) -> None:
        """Take the connection."""

    async def refuse(self) -> None:
        """Take it not."""

    async def receive(self) -> str:
        """Return what is said next."""

    async def send(self, text: str) -> None:
        """Send this, and wait while it is not read."""

    async def close(self, code: int, why: str) -> None:
        """Hang up."""


def json_reply(status: int, data: object) -> Reply:
    """Answer with data as JSON, also where a hook has put a number into it that JSON lacks."""
    try:
        text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    except ValueError:  # a hook measured what is not a number
        text = json.dumps(_finite(data), separators=(",", ":"), allow_nan=False)
    return Reply(status=status, body=text.encode("ascii"))


def said(status: int, text: str) -> Reply:
    """Answer with a sentence."""
    return json_reply(status, {"said": text})


def text_reply(text: str, name: str, kind: str = "text/plain") -> Reply:
    """Answer with a text to be kept under a name of ours."""
    return Reply(
        status=200,
        body=text.encode("utf-8", "replace"),
        type=f"{kind}; charset=utf-8",
        headers=(("Content-Disposition", f'attachment; filename="{name}"'),),
    )


def _finite(data: object) -> object:
    if isinstance(data, float) and not isfinite(data):
        return str(data)
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return data
