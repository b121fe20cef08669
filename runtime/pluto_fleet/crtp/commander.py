"""The commanders of a simulated Crazyflie: high-level commands, and low-level setpoints.

Take off, go to, land: each a packet that is answered. Low-level setpoints are sent by a gamepad, a
script or the end of a UDP link; only what they make of the drone's place is read from them: where it
is to be, or that its motors stop.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum

from .body import Body
from .flight_log import Point
from .packets import Errno, Port
from .supervisor import Supervisor

META, RELEASE = 1, 0
"""Channel and command of `send_notify_setpoint_stop`: the high-level commander may fly again."""


class Setpoint(IntEnum):
    """Setpoints of the generic port that say where it is to be; others let it stay where it is."""

    STOP = 0
    POSITION = 7
    HOVER = 10


STOP = bytes(14)
"""A setpoint of the older port without thrust: cflib's goodbye over UDP."""


def hover(height: float) -> bytes:
    """Return the setpoint to hover at its position."""
    return struct.pack("<Bffff", Setpoint.HOVER, 0.0, 0.0, 0.0, height)


def target_of(port: int, data: bytes, here: Point) -> Point | None:
    """Return the target of a setpoint for a drone that is here; None: motors off."""
    if port == Port.SETPOINT:
        return here if any(data[12:14]) else None
    kind = data[0] if data else Setpoint.STOP
    if kind == Setpoint.STOP:
        return None
    try:
        if kind == Setpoint.POSITION:
            x, y, z, _ = struct.unpack("<ffff", data[1:])
            return x, y, z
        if kind == Setpoint.HOVER:
            *_, height = struct.unpack("<ffff", data[1:])
            return here[0], here[1], height
    except struct.error:
        pass
    return here


WRONG_STATE = 1
"""The answer to a command in the wrong state: landing while it lands, taking off while it flies."""


class FlightCommand(IntEnum):
    """The high-level commands."""

    GROUP = 0
    STOP = 3
    GO_TO = 4
    TAKEOFF = 7
    LAND = 8
    GO_TO_2 = 12


@dataclass(frozen=True, slots=True)
class Answered:
    """A command with its answer, for the log."""

    what: str
    values: Mapping[str, float]
    answer: int


def command(data: bytes, body: Body, supervisor: Supervisor, now: float, busy: bool) -> Answered:
    """Carry out a packet's command, and return it with the answer.

    While low-level setpoints have priority, the answer is the same, and nothing moves.
    """
    what, values = _read(data)
    answer: int = Errno.ENOEXEC
    if what == "group":
        answer = Errno.OK
    elif what == "stop":
        body.cut()
        answer = Errno.OK
    elif what is not None:
        blocked = busy or not supervisor.can_fly
        answer = Errno.EBUSY if blocked else _fly(what, values, body, now)
        if answer == Errno.OK and not body.preempted:
            supervisor.setpoint_at = None
    return Answered(what or f"unknown {data[0]}", values, answer)


def _fly(what: str, values: Mapping[str, float], body: Body, now: float) -> int:
    flies, lands = body.plan is not None, body.plan is not None and body.plan.landing
    yaw = body.yaw if values.get("current_yaw") else values["yaw"]
    duration = values["duration"]
    if not all(map(math.isfinite, values.values())) or duration <= 0.0:
        return Errno.ENOEXEC
    x, y, z = body.planned(now)
    if what == "go_to":
        target = (values["x"], values["y"], values["z"])
        if values["relative"]:
            target, yaw = (x + target[0], y + target[1], z + target[2]), yaw + body.yaw
        body.fly(target, yaw, duration, now, landing=False)
        return Errno.OK
    if lands or (flies and what == "takeoff"):
        return WRONG_STATE  # to land on the ground is not refused: its motors start
    body.fly((x, y, values["z"]), yaw, duration, now, landing=what == "land")
    return Errno.OK


def _read(data: bytes) -> tuple[str | None, Mapping[str, float]]:
    """Parse a packet; return None if it is not understood."""
    try:
        match data[0]:
            case FlightCommand.GROUP:
                return "group", {}
            case FlightCommand.STOP:
                return "stop", {}
            case FlightCommand.TAKEOFF | FlightCommand.LAND:
                z, yaw, current, duration = struct.unpack("<ff?f", data[2:])
                what = "takeoff" if data[0] == FlightCommand.TAKEOFF else "land"
                return what, {"z": z, "yaw": yaw, "current_yaw": current, "duration": duration}
            case FlightCommand.GO_TO | FlightCommand.GO_TO_2:
                place = 3 if data[0] == FlightCommand.GO_TO else 4
                x, y, z, yaw, duration = struct.unpack("<fffff", data[place:])
                way = {"x": x, "y": y, "z": z, "yaw": yaw, "duration": duration}
                return "go_to", {**way, "relative": data[2]}
    except struct.error:
        pass
    return None, {}
