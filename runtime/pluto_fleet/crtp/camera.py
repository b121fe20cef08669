"""An AI-deck's camera: whoever connects is sent one picture after another."""

from __future__ import annotations

import asyncio
import struct
from contextlib import suppress

from .server import HOST

WIDTH, HEIGHT = 324, 244
_MAGIC, _RAW = 0xBC, 0
_CHUNK = 1000
_PAUSE = 0.1
"""Seconds between two pictures."""
_ROUTE, _FUNCTION = 0x0C, 0x05


def picture(number: int) -> bytes:
    """Return a picture: grey that changes across it, and from one to the next."""
    row = bytes((column + number) % 256 for column in range(WIDTH))
    return row * HEIGHT


def frames(number: int) -> bytes:
    """Return a picture as it is sent: a header, then pieces, each with its length before it."""
    pixels = picture(number)
    head = struct.pack("<BHHBBI", _MAGIC, WIDTH, HEIGHT, 1, _RAW, len(pixels))
    pieces = [head, *(pixels[at : at + _CHUNK] for at in range(0, len(pixels), _CHUNK))]
    return b"".join(
        struct.pack("<HBB", len(piece) + 2, _ROUTE, _FUNCTION) + piece for piece in pieces
    )


async def camera(port: int = 0) -> asyncio.Server:
    """Stream pictures to whoever connects; close what is returned to end it."""
    return await asyncio.start_server(_stream, HOST, port)


async def _stream(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    number = 0
    with suppress(OSError):
        while not reader.at_eof():
            writer.write(frames(number))
            await writer.drain()
            number += 1
            with suppress(TimeoutError):
                async with asyncio.timeout(_PAUSE):
                    await reader.read(1)
    writer.close()
    with suppress(OSError):
        await writer.wait_closed()


def port_of(server: asyncio.Server) -> int:
    """Return where it streams."""
    return int(server.sockets[0].getsockname()[1])
