"""The firmware's high-level commander: take off, go to, land, each a packet that is answered."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum

from .body import Body
from .ports import Errno
from .supervisor import Supervisor

WRONG_STATE = 1
"""The answer to what makes no sense now: to land where it lands, to take off where it flies."""


class Command(IntEnum):
    """What can be commanded."""

    GROUP = 0
    STOP = 3
    GO_TO = 4
    TAKEOFF = 7
    LAND = 8
    GO_TO_2 = 12


@dataclass(frozen=True, slots=True)
class Told:
    """A command, as it goes on record."""

    what: str
    values: Mapping[str, float]
    answer: int


def command(data: bytes, body: Body, supervisor: Supervisor, now: float, busy: bool) -> Told:
    """Do what a packet says, and return what it was with the answer to it.

    While low-level setpoints come first, that is the same answer, and nothing moves.
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
    return Told(what or f"unknown {data[0]}", values, answer)


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
    """Return what a packet says; None: nothing that is understood."""
    try:
        match data[0]:
            case Command.GROUP:
                return "group", {}
            case Command.STOP:
                return "stop", {}
            case Command.TAKEOFF | Command.LAND:
                z, yaw, current, duration = struct.unpack("<ff?f", data[2:])
                what = "takeoff" if data[0] == Command.TAKEOFF else "land"
                return what, {"z": z, "yaw": yaw, "current_yaw": current, "duration": duration}
            case Command.GO_TO | Command.GO_TO_2:
                place = 3 if data[0] == Command.GO_TO else 4
                x, y, z, yaw, duration = struct.unpack("<fffff", data[place:])
                way = {"x": x, "y": y, "z": z, "yaw": yaw, "duration": duration}
                return "go_to", {**way, "relative": data[2]}
    except struct.error:
        pass
    return None, {}
