"""An editor behind the real web server, and ways to ask it byte by byte."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.typing import Origin

from plutoc.editor.guard import Guard
from plutoc.editor.run import listening
from plutoc.editor.server import serve
from plutoc.editor.session import Session


@dataclass
class Served:
    """An editor that is being served."""

    session: Session
    guard: Guard

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.guard.port}"

    async def get(
        self, path: str, method: str = "GET", **headers: str
    ) -> tuple[int, dict[str, str], bytes]:
        """Ask for an address; names of headers have _ for -; return status, headers and body."""
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        sent = {"Host": self.host, "Connection": "close", **named}
        lines = [f"{method} {path} HTTP/1.1", *(f"{name}: {text}" for name, text in sent.items())]
        return answered(await self.say("\r\n".join([*lines, "", ""]).encode()))

    async def say(self, data: bytes) -> bytes:
        """Send bytes, and return all that comes back until the server hangs up."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.guard.port)
        found = b""
        try:
            async with asyncio.timeout(60):
                with suppress(ConnectionError):
                    writer.write(data)
                    await writer.drain()
                    while part := await reader.read(65536):
                        found += part
        finally:
            writer.close()
        return found

    def connect(self, token: str | None = None, **options: Any) -> connect:
        """Open a socket as a page of the editor's own does."""
        given = self.guard.token if token is None else token
        options.setdefault("origin", Origin(f"http://{self.host}"))
        headers = {"Cookie": f"{self.guard.cookie}={given}", **options.pop("headers", {})}
        return connect(
            f"ws://{self.host}/ws", additional_headers=headers, max_size=None, proxy=None, **options
        )


def answered(data: bytes) -> tuple[int, dict[str, str], bytes]:
    """Take an answer apart."""
    head, _, body = data.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    pairs = (line.partition(": ") for line in lines)
    return int(first.split(" ")[1]), {name.lower(): value for name, _, value in pairs}, body


async def heard(socket: ClientConnection, **facts: object) -> dict[str, Any]:
    """Wait for a message like this, and return it."""
    async with asyncio.timeout(60):
        while True:
            message: dict[str, Any] = json.loads(await socket.recv())
            if facts.items() <= message.items():
                return message


@asynccontextmanager
async def served(path: Path) -> AsyncIterator[Served]:
    """Serve an app on a port that is free."""
    session = Session(path)
    listener = listening("127.0.0.1", 0)
    guard = Guard(host="127.0.0.1", port=listener.getsockname()[1])
    ready = asyncio.Event()
    serving = asyncio.create_task(serve(session, guard, listener, ready.set))
    try:
        await ready.wait()
        yield Served(session, guard)
    finally:
        serving.cancel()
        with suppress(asyncio.CancelledError):
            await serving
