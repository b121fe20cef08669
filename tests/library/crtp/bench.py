"""A simulated Crazyflie on a bench: time passes only when it is told to."""

from __future__ import annotations

import struct
from random import Random

from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.flight_log import CommandRecord, FlightLog
from pluto_fleet.crtp.packets import LossyChannel, Packet, Port, packed, unpacked
from pluto_fleet.crtp.server import Value, let

CF1 = Build(id="cf1", home=(1.0, 2.0, 0.0))
_TICK = 0.01
_ACTIVE = 8
"""The bit of `supervisor.info` that a commanded flight sets."""


class Bench:
    """One drone, what it was sent, and what it has sent."""

    def __init__(self, build: Build = CF1) -> None:
        self.record = FlightLog()
        self.sent: list[Packet] = []
        self.drone = SimulatedCrazyflie(
            build, self.record, lambda raw: self.sent.append(unpacked(raw))
        )
        self.now = 100.0
        self.drone.step(self.now)

    def passes(self, seconds: float) -> None:
        for _ in range(round(seconds / _TICK)):
            self.now += _TICK
            self.drone.step(self.now)

    def told(self, port: int, channel: int, data: bytes) -> bytes | None:
        """Send a packet; return what the first answer says, or None."""
        before = len(self.sent)
        self.drone.receive(packed(port, channel, data), self.now)
        return self.sent[before].data if len(self.sent) > before else None

    def let(self, fault: str, value: Value = True) -> None:
        """Let something go wrong, as in `pluto_fleet.crtp.server`."""
        let(self.drone, LossyChannel(Random(1)), fault, value)

    def arm(self) -> bool:
        answer = self.told(Port.SUPERVISOR, 1, b"\1\1")
        assert answer is not None and answer[0] == 0x81
        return bool(answer[1])

    def takeoff(self, height: float = 1.0, seconds: float = 2.0) -> int:
        return self._commanded(struct.pack("<BBff?f", 7, 0, height, 0.0, True, seconds))

    def land(self, seconds: float = 2.0) -> int:
        return self._commanded(struct.pack("<BBff?f", 8, 0, 0.0, 0.0, True, seconds))

    def go_to(self, x: float, y: float, z: float, seconds: float) -> int:
        return self._commanded(struct.pack("<BBBBfffff", 12, 0, 0, 0, x, y, z, 0.0, seconds))

    def _commanded(self, data: bytes) -> int:
        answer = self.told(Port.HIGH_LEVEL, 0, data)
        assert answer is not None and answer[:2] == data[:2]
        return answer[3]

    def up(self) -> None:
        """Let it hover a metre above its home."""
        assert self.arm()
        assert self.takeoff() == 0
        self.passes(2.5)

    def lands(self) -> None:
        assert self.land() == 0
        while self.has(_ACTIVE):
            self.passes(_TICK)

    def has(self, bit: int) -> bool:
        return bool(self.drone.info() >> bit & 1)

    @property
    def commands(self) -> list[CommandRecord]:
        return self.record.commands

    @property
    def x(self) -> float:
        """How far east it is."""
        return self.drone.body.position[0]

    @property
    def z(self) -> float:
        """How high it is."""
        return self.drone.body.position[2]


def hovering(build: Build = CF1) -> Bench:
    """Return one that hovers a metre above its home."""
    bench = Bench(build)
    bench.up()
    return bench
