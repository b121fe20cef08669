"""One simulated Crazyflie: takes packets, gives packets, and lets time pass as it is told to."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from . import variables
from .battery import FLIGHT, Battery
from .body import Body, Point
from .commander import command
from .logs import Logs
from .params import Parameters
from .ports import NULL, PROTOCOL, Port, packed, unpacked
from .record import Deed, Place, Record
from .supervisor import Supervisor

_SURE, _UNSURE = 1e-5, 0.5
"""Square metres: how well it knows where it is."""
_SETTLES = 0.7
"""Seconds until it knows again, after its estimator was reset."""
_BOOTS = 1.0
"""Seconds in which it says nothing after a restart."""
_FRESH = 0.5
"""Seconds that a position from outside is worth something."""
_DOCK = 0.3
"""Metres around its home within which its pad charges it."""
_TRACED = 0.02
"""Seconds between two rows of the trace."""

_WHO = b"Bitcraze Crazyflie".ljust(30, b"\0")


@dataclass(frozen=True, slots=True, kw_only=True)
class Build:
    """What a drone is like."""

    id: str
    home: Point
    protocol: int = PROTOCOL
    auto_arm: bool = False
    level: float = 1.0
    """How full its battery is at the start."""
    flight: float = FLIGHT
    """Seconds that a full battery lasts in the air."""
    knows_where: bool = True
    """Whether it finds its position by itself; else only while somebody tells it."""
    seed: int = 0


class SimulatedCrazyflie:
    """A drone; whatever it sends goes to `send`. Times are those of `time.monotonic`."""

    def __init__(self, build: Build, record: Record, send: Callable[[bytes], None]) -> None:
        self.build, self._record, self._send = build, record, send
        random = Random(f"{build.seed}/{build.id}")
        self.body = Body(build.home, random)
        self.battery = Battery(level=build.level, flight=build.flight)
        self.supervisor = Supervisor(auto_arm=build.auto_arm)
        self.parameters = Parameters(variables.parameters(), self._changed)
        self._logs = Logs(variables.variables(self))
        self.on, self.busy, self.unsure = True, False, False
        self._boots_until = self._settles_at = self._told_at = -1e9
        self._now = self._traced = 0.0

    @property
    def answers(self) -> bool:
        """Whether its radio is on."""
        return self.on and self._now >= self._boots_until

    @property
    def variance(self) -> float:
        """How unsure it is of where it is, in square metres."""
        lost = not self.build.knows_where and self._now - self._told_at > _FRESH
        return _UNSURE if self.unsure or lost or self._now < self._settles_at else _SURE

    def info(self) -> int:
        """Return the bits of `supervisor.info`."""
        plan = self.body.plan
        return self.supervisor.info(
            high_level=plan is not None, finished=plan is None or plan.over(self._now)
        )

    def step(self, now: float) -> None:
        """Let time pass until now, and send what is due."""
        seconds, self._now = min(0.1, now - self._now) if self._now else 0.0, now
        was_flying = self.body.airborne
        self.body.step(now, seconds)
        thrust = self.body.plan is not None
        self.supervisor.step(now, thrust=thrust, tumbled=self.body.tumbled)
        if not self.supervisor.can_fly:
            self.body.cut()
        docked = not thrust and _near(self.body.position, self.build.home)
        if self.on and self.battery.step(seconds, loaded=thrust, charging=docked):
            self.note("switched off")
            self.switch(False)
        if now - self._traced >= _TRACED and (was_flying or self.body.airborne):
            self._traced = now
            self._record.was(Place(now, self.build.id, self.body.position))
        if was_flying and not self.body.airborne:
            self.note("down")
        if self.answers:
            for raw in self._logs.due(now):
                self._send(raw)

    def receive(self, raw: bytes, now: float) -> None:
        """Take a packet, and answer it."""
        if not raw or not self.answers:
            return
        if raw == NULL:
            self._send(NULL)
            return
        port, channel, data = unpacked(raw)
        match port:
            case Port.LINK:
                self._link(channel, data)
            case Port.LOG:
                answer = self._logs.take(channel, data, now)
                if answer is not None:
                    self._send(answer)
            case Port.PARAMETERS:
                for answer in self.parameters.take(channel, data):
                    self._send(answer)
            case Port.HIGH_LEVEL if data:
                told = command(data, self.body, self.supervisor, now, self.busy)
                self.note(told.what, **told.values, answer=told.answer)
                self._send(packed(port, channel, (data + bytes(3))[:3] + bytes([told.answer])))
            case Port.SUPERVISOR if data:
                self._supervise(channel, data, now)
            case Port.LOCALIZATION:
                self._locate(channel, data, now)
            case Port.MEMORY if channel == 0 and data[:1] == b"\1":
                self._send(packed(port, channel, b"\1\0"))  # there are none
            case Port.PLATFORM if channel == 1 and data:
                self._send(packed(port, channel, self._version(data)))
            case Port.SETPOINT | Port.GENERIC_SETPOINT:
                self._low_level(port, channel, now)

    def note(self, what: str, **values: float) -> None:
        """Put something on record."""
        body = self.body
        flying = body.airborne
        self._record.did(Deed(self._now, self.build.id, what, flying, body.position, values))

    def _link(self, channel: int, data: bytes) -> None:
        if channel == 1:
            self.note("asked")  # whoever connects begins with it
            self._send(packed(Port.LINK, 1, _WHO))
        elif channel in (0, 3):
            self._send(packed(Port.LINK, channel, data))

    def _version(self, data: bytes) -> bytes:
        match data[0]:
            case 0:
                return struct.pack("<Bi", 0, self.build.protocol)
            case 1:
                return data[:1] + b"2025.12 simulated"
            case _:
                return data[:1] + b"CF21"

    def _supervise(self, channel: int, data: bytes, now: float) -> None:
        what, supervisor = data[0], self.supervisor
        if channel == 0:
            asked = self.info()
            answer = struct.pack("<H", asked) if what == 0x0C else bytes([asked >> (what - 1) & 1])
            self._send(packed(Port.SUPERVISOR, 0, bytes([what | 0x80]) + answer))
            return
        match what:
            case 1 if len(data) > 1:
                done = supervisor.arm(bool(data[1]), now)
                self.note("arm" if data[1] else "disarm", done=done)
                answer = bytes([0x81, done, supervisor.armed])
            case 2:
                done = supervisor.recover()
                self.note("recover", done=done)
                answer = bytes([0x82, done, not supervisor.crashed])
            case 3:
                self._emergency_stop()
                answer = b"\x83\1"
            case 4:
                supervisor.fed_at = now
                self.note("watchdog")
                answer = b"\x84\1"
            case _:
                return
        self._send(packed(Port.SUPERVISOR, 1, answer))

    def _emergency_stop(self) -> None:
        self.note("emergency stop")
        self.supervisor.lock()
        self.body.cut()

    def _locate(self, channel: int, data: bytes, now: float) -> None:
        if channel == 0 or (channel == 1 and data[:1] in (b"\x08", b"\x09")):
            self._told_at = now
        elif channel == 1 and data[:1] == b"\3":
            self._emergency_stop()
        elif channel == 1 and data[:1] == b"\4":
            self.supervisor.fed_at = now

    def _low_level(self, port: int, channel: int, now: float) -> None:
        """Obey a setpoint for the motors: it comes before all that the commander has planned."""
        if port == Port.GENERIC_SETPOINT and channel == 1:
            self.note("setpoints end")
            self.supervisor.setpoint_at = None
            return
        self.note("setpoint", port=port)
        self.supervisor.setpoint_at = now
        self.body.cut()

    def _changed(self, name: str, value: float) -> None:
        self.note(f"set {name}", value=value)
        if name == "kalman.resetEstimation" and value:
            self._settles_at = self._now + _SETTLES

    def restart(self) -> None:
        """Let it begin anew where it is; in the air it falls."""
        self.note("restart")
        self.switch(True)
        self._boots_until = self._now + _BOOTS

    def switch(self, on: bool) -> None:
        """Switch it on or off; in the air it falls."""
        self.on = on
        self.body.cut()
        self._logs.reset()
        self.parameters.reset()
        self.supervisor.restart()


def _near(position: Point, home: Point) -> bool:
    (x, y, z), (hx, hy, hz) = position, home
    return abs(x - hx) < _DOCK and abs(y - hy) < _DOCK and abs(z - hz) < 0.05
