"""CRTP packets, their tables of contents, and a channel that loses or delays them.

A packet is a byte with port and channel, and up to 30 bytes of data.
"""

from __future__ import annotations

import binascii
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from random import Random
from typing import NamedTuple

NULL = b"\xff"
"""The null packet, with which a scan is made and answered."""

PROTOCOL = 12
"""The protocol version."""


class Port(IntEnum):
    """The ports."""

    CONSOLE = 0
    PARAMETERS = 2
    SETPOINT = 3
    MEMORY = 4
    LOG = 5
    LOCALIZATION = 6
    GENERIC_SETPOINT = 7
    HIGH_LEVEL = 8
    SUPERVISOR = 9
    PLATFORM = 13
    LINK = 15


class Errno(IntEnum):
    """The firmware's error codes."""

    OK = 0
    ENOENT = 2
    E2BIG = 7
    ENOEXEC = 8
    ENOMEM = 12
    EBUSY = 16
    EEXIST = 17
    EINVAL = 22


class Packet(NamedTuple):
    """A parsed packet."""

    port: int
    channel: int
    data: bytes


def packed(port: int, channel: int, data: bytes) -> bytes:
    return bytes([port << 4 | 0x0C | channel]) + data


def unpacked(raw: bytes) -> Packet:
    return Packet(raw[0] >> 4, raw[0] & 3, raw[1:])


@dataclass(slots=True)
class LossyChannel:
    """The channel to one drone and back."""

    random: Random
    loss: float = 0.0
    """The share of packets that is lost, each way."""
    latency: float = 0.0
    """Seconds that a packet takes, each way."""
    silent: bool = False
    """Whether all packets are lost."""

    def loses(self) -> bool:
        return self.silent or (self.loss > 0.0 and self.random.random() < self.loss)


_ITEM, _INFO = 2, 3
TABLE_CHANNEL = 0
"""The channel, on both ports."""


class TableOfContents:
    """The table of contents of one port."""

    def __init__(self, port: Port, items: Sequence[tuple[str, int]], tail: bytes = b"") -> None:
        self._port, self._tail = port, tail
        self.names = [name for name, _ in items]
        self._items = [bytes([kind]) + _spelled(name) for name, kind in items]
        self._checksum = binascii.crc32(bytes([port]) + b"".join(self._items))

    def answer(self, data: bytes) -> bytes | None:
        """Return the answer to a request about the table; None: it is another request."""
        if data[:1] == bytes([_INFO]):
            head = struct.pack("<BHI", _INFO, len(self._items), self._checksum)
            return packed(self._port, TABLE_CHANNEL, head + self._tail)
        if data[:1] == bytes([_ITEM]) and len(data) >= 3:
            number = int.from_bytes(data[1:3], "little")
            item = data[:3] + self._items[number] if number < len(self._items) else data[:1]
            return packed(self._port, TABLE_CHANNEL, item)
        return None


def _spelled(name: str) -> bytes:
    """Pack a name: group and name, each terminated by a zero."""
    return name.replace(".", "\0").encode() + b"\0"
