"""The tables of contents of parameters and log variables: what there is, and a checksum of it."""

from __future__ import annotations

import binascii
import struct
from collections.abc import Sequence

from .ports import Port, packed

_ITEM, _INFO = 2, 3
TABLE = 0
"""The channel, on both ports."""


class Table:
    """What is on one port, by its number."""

    def __init__(self, port: Port, items: Sequence[tuple[str, int]], tail: bytes = b"") -> None:
        self._port, self._tail = port, tail
        self.names = [name for name, _ in items]
        self._items = [bytes([kind]) + _spelled(name) for name, kind in items]
        self._checksum = binascii.crc32(bytes([port]) + b"".join(self._items))

    def answer(self, data: bytes) -> bytes | None:
        """Return the answer to a question about the table; None: it is none."""
        if data[:1] == bytes([_INFO]):
            head = struct.pack("<BHI", _INFO, len(self._items), self._checksum)
            return packed(self._port, TABLE, head + self._tail)
        if data[:1] == bytes([_ITEM]) and len(data) >= 3:
            number = int.from_bytes(data[1:3], "little")
            item = data[:3] + self._items[number] if number < len(self._items) else data[:1]
            return packed(self._port, TABLE, item)
        return None


def _spelled(name: str) -> bytes:
    """Return a name as it is sent: group and name, a zero after each."""
    return name.replace(".", "\0").encode() + b"\0"
