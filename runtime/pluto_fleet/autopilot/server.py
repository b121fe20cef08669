"""Many simulated vehicles behind one UDP port, told apart by their system ids; and their faults."""

from __future__ import annotations

import asyncio
from collections import defaultdict, deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from ..process.simulator import listen
from .ardupilot import ArduPilot
from .equipment import Around
from .px4 import Px4
from .station_link import StationLink
from .vehicle import Build, Doing, Faults, Vehicle

HOST = "127.0.0.1"
_TICK = 0.02
"""Seconds."""
_LONGEST = 0.5
"""Seconds of motion at most in one step: a stopped process is no long flight."""

MAKES: Mapping[str, Callable[[Build, Around | None], Vehicle]] = {
    "px4": Px4,
    "ardupilot": ArduPilot,
}

Value = float | bool | str
Address = tuple[str | Any, int]


def _level(vehicle: Vehicle, level: Value) -> None:
    vehicle.charge = float(level)


def _pilot(vehicle: Vehicle, mode: Value) -> None:
    doing = Doing(mode)
    vehicle.switch(doing)
    gives_back = doing is Doing.GO
    if gives_back:
        vehicle.stop_here()
    vehicle.acts_by_itself(vehicle.armed and not gives_back)


def _astray(vehicle: Vehicle, metres: Value) -> None:
    vehicle.err(float(metres))


def _system(vehicle: Vehicle, number: Value) -> None:
    vehicle.build = replace(vehicle.build, system=int(number))


def _aloft(vehicle: Vehicle, height: Value) -> None:
    """Have it hover there already."""
    vehicle.arm()
    vehicle.switch(Doing.GO)
    vehicle.body.at[2] = float(height)
    vehicle.stop_here()


def _reboot(vehicle: Vehicle, _: Value) -> None:
    """Restart the autopilot: its motors stop, and what it was told is forgotten."""
    vehicle.armed = False
    vehicle.doing = Doing.HOLD
    vehicle.now = 0.0
    vehicle.err(0.0)
    vehicle.acts_by_itself(False)
    vehicle.faults = Faults()


def _set(vehicle: Vehicle, value: Value, name: str) -> None:
    vehicle.parameters[name].value = float(value)


_OTHERS: Mapping[str, Callable[[Vehicle, Value], None]] = {
    "level": _level,
    "pilot": _pilot,
    "reboot": _reboot,
    "astray": _astray,
    "system": _system,
    "aloft": _aloft,
}
FAULTS = (*Faults.__dataclass_fields__, *_OTHERS)
"""All names: those of `Faults`; `level` of its battery; `pilot`, who takes it over into a mode, and gives it back by
`go`; `reboot`; `system`, its id; `aloft`, the height at which it hovers."""


def let(vehicle: Vehicle, name: str, value: Value) -> None:
    """Set or reset a fault, or with `parameter NAME` a parameter; raise `ValueError` if there is none of this name."""
    kind, _, parameter = name.partition(" ")
    if kind == "parameter" and parameter in vehicle.parameters:
        _set(vehicle, value, parameter)
    elif name in _OTHERS:
        _OTHERS[name](vehicle, value)
    elif name in FAULTS:
        setattr(vehicle.faults, name, value)
    else:
        raise ValueError(f"{name}: no such fault: there are {', '.join(FAULTS)}")


class Server(asyncio.DatagramProtocol):
    """The vehicles, and their socket."""

    def __init__(self, builds: Sequence[Build] = (), around: Around | None = None) -> None:
        self._around = around
        self._transport: asyncio.DatagramTransport | None = None
        self._clients: dict[Address, float] = {}
        """Who has spoken, and when last."""
        self._reader = mavlink.MAVLink(None)
        self._reader.robust_parsing = True
        self._links: dict[str, StationLink] = {}
        self._waiting: defaultdict[str, deque[tuple[float, bytes]]] = defaultdict(deque)
        """By vehicle, messages that are heard late, with when."""
        self.vehicles: dict[str, Vehicle] = {}
        for build in builds:
            self.join(build)
        self._ticking: asyncio.Task[None] | None = None
        self.port = 0
        self.talked = 0.0

    def join(self, build: Build) -> Vehicle:
        """Have one more vehicle."""
        vehicle = MAKES[build.make](build, self._around)
        self.vehicles[build.id] = vehicle
        self._links[build.id] = StationLink(vehicle, partial(self._send, vehicle))
        return vehicle

    async def start(self, port: int = 0) -> None:
        """Listen at a port; at any free one for 0, or one that is taken."""
        self.talked = asyncio.get_running_loop().time()
        self._transport, self.port = await listen(self, HOST, port)
        self._ticking = asyncio.create_task(self._tick())

    @property
    def uris(self) -> dict[str, str]:
        return {
            id: f"mavlink+udp://{HOST}:{self.port}?system={vehicle.build.system}"
            for id, vehicle in self.vehicles.items()
        }

    @property
    def airborne(self) -> bool:
        return any(vehicle.high for vehicle in self.vehicles.values())

    @property
    def quiet(self) -> float:
        """Seconds since the last packet."""
        return asyncio.get_running_loop().time() - self.talked

    async def close(self) -> None:
        if self._ticking is not None:
            self._ticking.cancel()
            await asyncio.gather(self._ticking, return_exceptions=True)
        if self._transport is not None:
            self._transport.close()

    def datagram_received(self, data: bytes, addr: Address) -> None:
        self.talked = asyncio.get_running_loop().time()
        self._clients[addr] = self.talked
        for message in self._reader.parse_buffer(data) or ():
            target = getattr(message, "target_system", 0)
            for link in self._links.values():
                if target in (0, link.vehicle.build.system) and not link.vehicle.faults.silent:
                    link.hear(message)

    def _send(self, vehicle: Vehicle, data: bytes) -> None:
        if vehicle.faults.silent:
            return
        waiting = self._waiting[vehicle.build.id]
        if vehicle.faults.late > 0 or waiting:  # what is sent later does not overtake
            now = asyncio.get_running_loop().time()
            waiting.append((now + vehicle.faults.late, data))
        else:
            self._put(data)

    def _put_late(self, now: float) -> None:
        for waiting in self._waiting.values():
            while waiting and waiting[0][0] <= now:
                self._put(waiting.popleft()[1])

    def _put(self, data: bytes) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        for client in self._clients:
            self._transport.sendto(data, client)

    async def _tick(self) -> None:
        loop = asyncio.get_running_loop()
        last = loop.time()
        while True:
            now = loop.time()
            passed = min(_LONGEST, now - last)
            last = now
            self._put_late(now)
            self._clients = {who: at for who, at in self._clients.items() if now - at < _FORGOTTEN}
            for link in self._links.values():
                _pass(link.vehicle, passed)
                link.speak()
            await asyncio.sleep(_TICK)


_FORGOTTEN = 10.0
"""Seconds after which a client that says nothing is told nothing."""


def _pass(vehicle: Vehicle, seconds: float) -> None:
    """Let time pass in steps that are short enough for the motion."""
    while seconds > 0:
        step = min(seconds, 2 * _TICK)
        vehicle.step(step)
        seconds -= step
