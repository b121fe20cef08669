"""Says where things are that move in a simulated world, as the built-in tracker `lines` reads it."""

from __future__ import annotations

import asyncio
import json
import time
from contextlib import suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.events.world import MovingWorld

_HOST = "127.0.0.1"
_EVERY = 0.1
"""Seconds between two looks at what moves."""


class TrackServer:
    """Serves any number of clients; the time of its world begins with it."""

    def __init__(self, world: MovingWorld) -> None:
        self._world = world
        self._began = time.monotonic()
        self._server: asyncio.Server | None = None

    async def address(self) -> str:
        """Return where it is read; it serves from the first time that this is asked."""
        if self._server is None:
            self._server = await asyncio.start_server(self._say, _HOST, 0)
        return f"{_HOST}:{self._server.sockets[0].getsockname()[1]}"

    def close(self) -> None:
        if self._server is not None:
            self._server.close()

    async def _say(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Say it to a client, again and again."""
        with suppress(OSError):
            while not reader.at_eof():
                for id, track in self._world.tracks(time.monotonic() - self._began).items():
                    writer.write(json.dumps({"id": id, **track}).encode() + b"\n")
                await writer.drain()
                await asyncio.sleep(_EVERY)
        writer.close()
