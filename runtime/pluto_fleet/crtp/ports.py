"""CRTP packets: a byte that says port and channel, and up to 30 bytes."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

NULL = b"\xff"
"""Says nothing; whoever looks for drones sends it, and is answered the same."""

PROTOCOL = 12
"""The version of the protocol that is spoken."""


class Port(IntEnum):
    """What a packet is about."""

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
    """What the firmware answers when it does not do what it is told."""

    OK = 0
    ENOENT = 2
    E2BIG = 7
    ENOEXEC = 8
    ENOMEM = 12
    EBUSY = 16
    EEXIST = 17
    EINVAL = 22


class Packet(NamedTuple):
    """A packet, taken apart."""

    port: int
    channel: int
    data: bytes


def packed(port: int, channel: int, data: bytes) -> bytes:
    """Return a packet as it goes over the air."""
    return bytes([port << 4 | 0x0C | channel]) + data


def unpacked(raw: bytes) -> Packet:
    """Take apart what came over the air."""
    return Packet(raw[0] >> 4, raw[0] & 3, raw[1:])
