"""One simulated Crazyflie, driven by packets and by the given time."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from ..shared.alone.world import World
from ..shared.domain.airspace import Airspace
from ..shared.domain.fleet_data import WorldData
from ..shared.domain.model import Category
from ..shared.domain.motion import CRAZYFLIE
from .battery import CHARGE, FLIGHT, CarriedBody
from .body import NOISE, RATE, Body, Estimator
from .commander import META, RELEASE, Supervisor, command, target_of
from .flight_log import CommandRecord, FlightLog, Point, PositionRecord
from .logs import Logs, quantities, variables
from .packets import NULL, PROTOCOL, Port, packed, unpacked
from .params import Parameters, parameters

_UNSURE = 0.5
"""The variance of its position while it is unsure, in square metres."""
_SETTLES = 0.7
"""Seconds until its estimate has settled after a reset."""
_BOOTS = 1.0
"""Seconds of silence after a restart."""
_TRACED = 0.02
"""Seconds between two rows of the trace."""

_LATEST = 5.0
"""The most seconds of motion to catch up after a delay of the machine."""

RELEASES = {8: "2024.10", 9: "2025.02", 10: "2025.12", 12: "2026.08"}
"""The newest firmware release for each protocol version."""

_WHO = b"Bitcraze Crazyflie".ljust(30, b"\0")


EMPTY_WORLD = World(0, Airspace(), WorldData())


@dataclass(frozen=True, slots=True, kw_only=True)
class Build:
    """The build of a drone."""

    id: str
    home: Point
    protocol: int = PROTOCOL
    auto_arm: bool = False
    """Whether it arms by itself, as those with brushed motors do; else on request."""
    level: float = 1.0
    """Its initial charge."""
    flight: float = FLIGHT
    """Seconds that a full battery lasts in the air."""
    charge: float = CHARGE
    """Seconds from an empty battery to a full one on the pad; infinite: it has none."""
    cells: int = 1
    """How many its battery has: a Bolt or a Flapper has two."""
    shuts_down: bool = False
    """Whether its battery switches it off at 3.0 V a cell; few builds do that."""
    knows_where: bool = True
    """Whether it finds its position by itself; else only while it is told."""
    noise: float = NOISE
    """The noise of a position fix in metres: 0.01 for Lighthouse, 0.05 to 0.15 for UWB."""
    rate: float = RATE
    """The rate of its own position fixes per second."""
    seed: int = 0


class SimulatedCrazyflie:
    """A drone, which sends packets by `send`. Times are those of `time.monotonic`."""

    def __init__(
        self,
        build: Build,
        log: FlightLog,
        send: Callable[[bytes], None],
        world: World = EMPTY_WORLD,
    ) -> None:
        self.build, self._log, self._send = build, log, send
        self.now = self._traced = 0.0
        random = Random(f"{build.seed}/{build.id}")
        self.body = Body(build.home, random)
        self.estimator = Estimator(
            Random(f"estimate/{build.seed}/{build.id}"),
            own=build.knows_where,
            noise=build.noise,
            rate=build.rate,
        )
        kind = Category(
            name="crazyflie",
            speed=1.0,
            flight_time=build.flight,
            charge_time=build.charge,
            motion=CRAZYFLIE.exact,
        )
        self.carried = CarriedBody(
            build.id,
            build.home,
            kind,
            world,
            self,
            cells=build.cells,
            shuts_down=build.shuts_down,
        )
        """The drone as all simulated ones are: its battery, and what it measures."""
        self.supervisor = Supervisor(auto_arm=build.auto_arm)
        self.parameters = Parameters(parameters(build.cells), self._changed)
        self.variables = variables(
            self.body,
            self.carried,
            self.supervisor,
            quantities(world),
            variance=lambda: self.variance,
            info=self.info,
            holds=lambda: self.parameters["gripper.closed"],
        )
        """Its log variables."""
        self._logs = Logs(self.variables)
        self.on, self.busy, self.unsure = True, False, False
        self._boots_until = self._settles_at = -1e9

    @property
    def answers(self) -> bool:
        return self.on and self.now >= self._boots_until

    @property
    def variance(self) -> float:
        """The variance of its position, in square metres."""
        if self.unsure or self.now < self._settles_at:
            return _UNSURE
        return self.estimator.variance(self.now)

    def info(self) -> int:
        plan = self.body.plan
        return self.supervisor.info(
            high_level=plan is not None,
            finished=plan is None or plan.over(self.now),
            planner_off=self.body.planner_off,
        )

    def step(self, now: float) -> None:
        """Advance the time until now, and send what is due."""
        passed = now - self.now if self.now else 0.0
        is_new = not self.now
        self.now = now
        if is_new:
            self.carried.stand(self.build.home, self.build.level)
        seconds = min(0.1, passed)
        was_flying = self.body.airborne
        self.estimator.step(now)
        self.body.error = self.estimator.error(now)
        self.body.sway, self.body.limits = self.estimator.sway, self._limits
        self.body.step(now, min(_LATEST, passed))
        thrust = self.body.motors
        self.supervisor.step(now, thrust=thrust, tumbled=self.body.tumbled)
        if not self.supervisor.can_fly:
            self.body.cut()
        self.carried.carried(self.body.position, motors=thrust)
        if self.on and self.carried.switches_off(seconds):
            self.note("switched off")
            self.switch(False)
        if now - self._traced >= _TRACED and (was_flying or self.body.airborne):
            self._traced = now
            self._log.position(PositionRecord(now, self.build.id, self.body.position))
        if was_flying and not self.body.airborne:
            self.note("down")
        if self.answers:
            for raw in self._logs.due(now):
                self._send(raw)

    def hear(self, raw: bytes) -> None:
        """Process a packet of another sender at once."""
        self.receive(raw, self.now)

    def receive(self, raw: bytes, now: float) -> None:
        """Process a packet, and answer it."""
        if not raw or not self.answers:
            return
        if raw == NULL:
            self._send(NULL)
            return
        port, channel, data = unpacked(raw)
        match port:
            case Port.LINK:
                self._link(channel, data)
            case Port.LOG | Port.PARAMETERS:
                if port == Port.LOG:
                    answer = self._logs.take(channel, data, now)
                else:
                    answer = self.parameters.take(channel, data)
                if answer is not None:
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
                self._low_level(port, channel, data, now)

    def note(self, what: str, **values: float) -> None:
        body = self.body
        flying = body.airborne
        self._log.command(
            CommandRecord(self.now, self.build.id, what, flying, body.position, values)
        )

    def _link(self, channel: int, data: bytes) -> None:
        if channel == 1:
            self.note("asked")  # a client begins with it
            self._send(packed(Port.LINK, 1, _WHO))
        elif channel in (0, 3):
            self._send(packed(Port.LINK, channel, data))

    def _version(self, data: bytes) -> bytes:
        match data[0]:
            case 0:
                return struct.pack("<Bi", 0, self.build.protocol)
            case 1:
                return data[:1] + _release(self.build.protocol)
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
                return
            case 4:
                supervisor.fed_at = now
                self.note("watchdog")
                return
            case _:
                return
        self._send(packed(Port.SUPERVISOR, 1, answer))

    def _emergency_stop(self) -> None:
        self.note("emergency stop")
        self.supervisor.lock()
        self.body.cut()

    def _locate(self, channel: int, data: bytes, now: float) -> None:
        if channel == 0 or (channel == 1 and data[:1] in (b"\x08", b"\x09")):
            self.estimator.told(now)
        elif channel == 1 and data[:1] == b"\3":
            self._emergency_stop()
        elif channel == 1 and data[:1] == b"\4":
            self.supervisor.fed_at = now

    def _low_level(self, port: int, channel: int, data: bytes, now: float) -> None:
        """Follow a low-level setpoint, which overrides the commander until released."""
        if port == Port.GENERIC_SETPOINT and channel == META:
            if data[:1] == bytes([RELEASE]):
                self.note("setpoints end")
                self.body.release()
            return
        self.note("setpoint", port=port)
        self.supervisor.setpoint_at = now
        place = target_of(port, data, self.body.estimate)
        self.body.obey(place if self.supervisor.can_fly else None)

    def _changed(self, name: str, value: float) -> None:
        self.note(f"set {name}", value=value)
        if name == "kalman.resetEstimation" and value:
            self._settles_at = self.now + _SETTLES
        elif name == "supervisor.landedTimeout":
            self.supervisor.landed = value / 1000.0

    @property
    def _limits(self) -> tuple[float, float, float]:
        x, y, z = (self.parameters[f"posCtlPid.{axis}VelMax"] for axis in "xyz")
        return x, y, z

    def restart(self) -> None:
        self.note("restart")
        self.switch(True)
        self._boots_until = self.now + _BOOTS

    def switch(self, on: bool) -> None:
        """Switch it on or off; in the air it falls."""
        self.on = on
        self.body.cut()
        self.body.preempted = self.body.planner_off = False
        self._logs.reset()
        self.parameters.reset()
        self.supervisor.restart()


def _release(protocol: int) -> bytes:
    """Return the newest release of the firmware that speaks so old a protocol."""
    known = [name for spoken, name in RELEASES.items() if spoken <= protocol]
    return (known[-1] if known else "2023.11").encode() + b" simulated"
