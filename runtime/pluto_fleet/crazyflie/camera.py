"""One picture from the streamer of an AI-deck: it sends all that its camera sees, by TCP.

Each packet has its length, two bytes for its way, and a part of what is sent: first the head of a
picture, then its bytes. What the camera sees raw becomes a picture of grey levels that any viewer
shows; else it is a JPEG as it comes.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from struct import Struct

_PACKET = Struct("<HBB")
_WAY = 2
"""Bytes of the length that are not part of what is sent."""
_HEAD = Struct("<BHHBBI")
_MAGIC = 0xBC
_RAW = 0
_LARGEST = 1 << 20
"""Bytes: its camera has a tenth of that."""

LIMIT = 6.0
"""Seconds; it sends some pictures a second."""


class NoPicture(Exception):
    """What came is no picture."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture as a file has it."""

    data: bytes
    suffix: str


async def picture(where: tuple[str, int]) -> Picture:
    """Return the next whole picture; raise `OSError`, `TimeoutError` or `NoPicture`.

    Each time anew: on a line that stays open, old pictures wait.
    """
    async with asyncio.timeout(LIMIT):
        reader, writer = await asyncio.open_connection(*where)
        try:
            return await _next(reader)
        except asyncio.IncompleteReadError:
            raise NoPicture("it ended within a picture") from None
        finally:
            writer.transport.abort()


async def _next(reader: asyncio.StreamReader) -> Picture:
    while True:
        head = await _part(reader)
        if len(head) != _HEAD.size or head[0] != _MAGIC:
            continue  # the middle of a picture, or something else that the deck says
        _, width, height, depth, kind, size = _HEAD.unpack(head)
        if not 0 < size <= _LARGEST:
            raise NoPicture(f"a picture of {size} bytes was announced")
        data = bytearray()
        while len(data) < size:
            data += await _part(reader)
        if kind != _RAW:
            return Picture(data=bytes(data), suffix=".jpg")
        if len(data) != width * height * max(1, depth // 8):
            raise NoPicture(f"{len(data)} bytes are no picture of {width} by {height}")
        grey = f"P5 {width} {height} 255\n".encode()
        return Picture(data=grey + data, suffix=".pgm")


async def _part(reader: asyncio.StreamReader) -> bytes:
    """Return what one packet has."""
    length, _, _ = _PACKET.unpack(await reader.readexactly(_PACKET.size))
    return await reader.readexactly(max(0, length - _WAY))
