"""A line over one of Starlette's WebSockets."""

from __future__ import annotations

from .borrowed import Borrowed, Receive, Scope, Send
from .http import Closed

_LONGEST_REASON = 120
"""Bytes: what fits into the frame that closes a connection."""


class SocketLine:
    """A page that stays connected."""

    def __init__(self, parts: Borrowed, scope: Scope, receive: Receive, send: Send) -> None:
        self._parts = parts
        self._socket = parts.websocket(scope, receive, send)

    async def open(self) -> None:
        """Take the connection."""
        try:
            await self._socket.accept()
        except self._parts.gone:
            raise Closed from None

    async def refuse(self) -> None:
        """Take it not: the server says 403, and a browser tells its page no more than that."""
        try:
            await self._socket.close(1008, "")
        except self._parts.gone:
            raise Closed from None

    async def receive(self) -> str:
        """Return what is said next; what is no text is as good as nothing."""
        try:
            message = await self._socket.receive()
        except self._parts.gone:
            raise Closed from None
        if message["type"] == "websocket.disconnect":
            raise Closed
        text = message.get("text")
        return text if isinstance(text, str) else ""

    async def send(self, text: str) -> None:
        """Say this; whoever does not read is waited for."""
        try:
            await self._socket.send_text(text)
        except self._parts.gone:
            raise Closed from None

    async def close(self, code: int, why: str) -> None:
        """Hang up."""
        reason = why.encode()[:_LONGEST_REASON].decode(errors="ignore")
        try:
            await self._socket.close(code, reason)
        except self._parts.gone:
            raise Closed from None
