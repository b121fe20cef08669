"""Low-level setpoints, as a gamepad, a script or the end of a UDP link sends them.

Only what becomes of the drone's place is told from them: where it is to be, or that its motors stop.
"""

from __future__ import annotations

import struct
from enum import IntEnum

from .ports import Port
from .record import Point

META, RELEASE = 1, 0
"""Channel and command of `send_notify_setpoint_stop`: the high-level commander may fly again."""


class Kind(IntEnum):
    """Setpoints of the generic port that say where a drone is to be."""

    STOP = 0
    Z_DISTANCE_LEGACY = 2
    HOVER_LEGACY = 5
    FULL_STATE = 6
    POSITION = 7
    Z_DISTANCE = 9
    HOVER = 10


_WITH_HEIGHT = (Kind.Z_DISTANCE_LEGACY, Kind.HOVER_LEGACY, Kind.Z_DISTANCE, Kind.HOVER)

STOP = bytes(14)
"""A setpoint of the older port without thrust: cflib's goodbye over UDP."""


def hover(height: float) -> bytes:
    """Return the setpoint of somebody who lets it hover where it is."""
    return struct.pack("<Bffff", Kind.HOVER, 0.0, 0.0, 0.0, height)


def wanted(port: int, data: bytes, here: Point) -> Point | None:
    """Return where a setpoint wants a drone that is here; None: its motors stop."""
    if port == Port.SETPOINT:
        return here if any(data[12:14]) else None
    kind = data[0] if data else Kind.STOP
    if kind == Kind.STOP:
        return None
    try:
        if kind == Kind.POSITION:
            x, y, z, _ = struct.unpack("<ffff", data[1:])
            return x, y, z
        if kind == Kind.FULL_STATE:
            x, y, z = struct.unpack("<hhh", data[1:7])
            return x / 1000.0, y / 1000.0, z / 1000.0
        if kind in _WITH_HEIGHT:
            *_, height = struct.unpack("<ffff", data[1:])
            return here[0], here[1], height
    except struct.error:
        pass
    return here
