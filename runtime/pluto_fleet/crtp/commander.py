"""The supervisor of a simulated Crazyflie, which arms and locks, and its commanders: high-level commands, and
low-level setpoints.

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

_HYSTERESIS = 2.0
"""Seconds after the motors have stopped within which it still counts as flying."""
LANDED = 3.0
_UNUSED = 30.0
"""Seconds after which an armed drone is disarmed: after a landing, or without a take-off."""
_RESETS = 0.12
"""Seconds after a disarming within which it cannot be armed: three cycles of its supervisor."""
_NOTICES = 0.05
"""Seconds until it notices turning motors: a take-off just before the disarming is cancelled."""
_LEVEL = 0.5
_LOCK = 2.0
"""Seconds without a new low-level setpoint, after which it levels out, and then locks."""
_FED = 1.0
"""The time-out of the emergency watchdog, once it was fed, in seconds."""
_NEVER = -1e9


@dataclass(slots=True)
class Supervisor:
    """The state of one drone; times are handed in."""

    auto_arm: bool = False
    armed: bool = False
    locked: bool = False
    faulty: bool = False
    """Whether one of its decks has a fault."""
    crashed: bool = False
    tumbled: bool = False
    flying: bool = False
    setpoint_at: float | None = None
    """The time of the last low-level setpoint in effect, or None."""
    fed_at: float | None = None
    """When the emergency watchdog was last fed."""
    landed: float = LANDED
    """Seconds on the ground after which it is disarmed."""
    _turns_since: float | None = None
    _resets_until: float = _NEVER
    _resets: bool = False
    _thrust_at: float = _NEVER
    _armed_at: float = _NEVER
    _warned: bool = False

    @property
    def can_fly(self) -> bool:
        return self.armed and not (self.locked or self.crashed or self.tumbled)

    @property
    def can_arm(self) -> bool:
        blocked = self.locked or self.crashed or self.tumbled or self.faulty
        return not (self.armed or self._resets or blocked)

    def arm(self, on: bool, now: float) -> bool:
        """Arm or disarm; return whether that was done."""
        if on and not self.armed:
            if not self.can_arm:
                return False
            self.armed = True
            self._armed_at = now
            self._thrust_at = _NEVER
        elif not on and self.armed:
            if self.flying:
                return False
            self._reset(now)
        return True

    def _reset(self, now: float) -> None:
        """Disarm it; for a moment it cannot be armed."""
        self.armed = False
        self._resets = True
        self._resets_until = now + _RESETS

    def recover(self) -> bool:
        """Leave the crashed state, if it stands upright; return whether that was done."""
        if self.crashed and not self.tumbled:
            self.crashed = self.armed = False
        return not self.crashed

    def lock(self) -> None:
        self.locked = True
        self.armed = False

    def restart(self) -> None:
        self.armed = self.locked = self.crashed = self.flying = False
        self.faulty = self._warned = self._resets = False
        self._turns_since = None
        self.setpoint_at = self.fed_at = None
        self._thrust_at = self._armed_at = _NEVER

    def step(self, now: float, *, thrust: bool, tumbled: bool) -> None:
        self._turns_since = (self._turns_since or now) if thrust else None
        if self._turns_since is not None and now - self._turns_since >= _NOTICES:
            self._thrust_at = now
        self.tumbled = tumbled
        self.flying = now - self._thrust_at < _HYSTERESIS and not (self.locked or self.crashed)
        if tumbled and (self.flying or self.armed):
            self.crashed = True
            self.armed = False
            self.flying = False
        self._watch(now)
        self._resets = self._resets and now < self._resets_until
        if self.armed and not self.flying:
            since = max(self._armed_at, self._thrust_at)
            limit = _UNUSED if self._thrust_at == _NEVER else _HYSTERESIS + self.landed
            if self.faulty or now - since >= limit:
                self._reset(now)
        if self.auto_arm and self.can_arm:
            self.arm(True, now)

    def _watch(self, now: float) -> None:
        """Lock if setpoints, the watchdog's feeding, or a deck have failed in the air."""
        if self.faulty and self.flying:
            self.lock()
        age = 0.0 if self.setpoint_at is None else now - self.setpoint_at
        self._warned = age > _LEVEL and (self._warned or self.flying or self.crashed)
        if self._warned and age > _LOCK:
            self.lock()
        if age > _LOCK:
            self.setpoint_at = None
        if self.fed_at is not None and now - self.fed_at > _FED:
            self.lock()

    def info(self, *, high_level: bool, finished: bool, planner_off: bool = False) -> int:
        bits = (
            self.can_arm,
            self.armed,
            self.auto_arm,
            self.can_fly,
            self.flying,
            self.tumbled,
            self.locked,
            self.crashed,
            high_level,
            finished,
            planner_off,
            self.faulty,
        )
        return sum(1 << place for place, bit in enumerate(bits) if bit)


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
