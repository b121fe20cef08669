"""Many simulated drones in one loop, a UDP port each, and their faults: `udp://127.0.0.1:PORT` reaches one."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations
from math import dist
from random import Random
from typing import Any

from ..process.simulator import listen
from ..shared.alone.world import World
from .commander import STOP, hover
from .drone import EMPTY_WORLD, Build, SimulatedCrazyflie
from .flight_log import FlightLog
from .packets import NULL, LossyChannel, Port, packed

Value = float | bool | list[float]


def _tumble(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.tumbled = True
    drone.body.cut()


def _fetch(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.place(drone.build.home)
    drone.restart()


def _setpoint(drone: SimulatedCrazyflie, height: float) -> None:
    if height is True:
        drone.hear(packed(Port.SETPOINT, 0, STOP))
    else:
        drone.hear(packed(Port.GENERIC_SETPOINT, 0, hover(height)))


def _on(drone: SimulatedCrazyflie, on: float) -> None:
    if on:
        drone.restart()
    else:
        drone.switch(False)


_OF_DRONES: Mapping[str, Callable[[SimulatedCrazyflie, float], None]] = {
    "tumble": _tumble,
    "fetch": _fetch,
    "volts": lambda drone, volts: drone.carried.set_volts(volts),
    "level": lambda drone, level: drone.carried.charge_to(level),
    "busy": lambda drone, on: setattr(drone, "busy", bool(on)),
    "unsure": lambda drone, on: setattr(drone, "unsure", bool(on)),
    "upright": lambda drone, _: drone.body.place(drone.body.position),
    "fixes": lambda drone, on: drone.estimator.lose(not on),
    "noise": lambda drone, metres: setattr(drone.estimator, "noise", metres),
    "rate": lambda drone, hertz: setattr(drone.estimator, "rate", hertz),
    "deck": lambda drone, on: setattr(drone.supervisor, "faulty", bool(on)),
    "setpoint": _setpoint,
    "lock": lambda drone, _: drone.supervisor.lock(),
    "restart": lambda drone, _: drone.restart(),
    "on": _on,
}
_OF_AIR = ("silent", "loss", "latency")

FAULTS = (*_OF_AIR, "place", *_OF_DRONES)
"""All names. `fetch` is what a person does for a drone: stands it on its pad, and restarts it;
`upright`: stands it up where it lies. `fixes`: whether positions reach it; `noise` and `rate`: metres
by which they are off, and how many its own system gives a second. `setpoint`: of a stranger, that
lets it hover so high, or stops its motors. `deck`: whether one has a fault.
"""


def let(drone: SimulatedCrazyflie, air: LossyChannel, name: str, value: Value) -> None:
    """Set or reset a fault; raise `ValueError` if there is none of this name."""
    if name == "place" and isinstance(value, list):
        x, y, z = value
        drone.body.place((x, y, z))
    elif name not in FAULTS or isinstance(value, list):
        raise ValueError(f"{name}: no such fault: there are {', '.join(FAULTS)}")
    elif name in _OF_DRONES:
        drone.note(f"fault {name}", value=value)
        _OF_DRONES[name](drone, value)
    elif name == "silent":
        air.silent = bool(value)
    elif name == "loss":
        air.loss = value
    else:
        air.latency = value


HOST = "127.0.0.1"
_TICK = 0.01
"""Seconds."""
_TOUCH = 0.12
"""Metres between two drones at which they touch: they are as wide as that."""

Address = tuple[str | Any, int]


class Endpoint(asyncio.DatagramProtocol):
    """A drone behind a UDP port."""

    def __init__(self, build: Build, log: FlightLog, world: World) -> None:
        self.drone = SimulatedCrazyflie(build, log, self._send, world)
        self.air = LossyChannel(Random(f"air/{build.seed}/{build.id}"))
        self.talked = 0.0
        self._client: Address | None = None
        self._transport: asyncio.DatagramTransport | None = None
        self.port = 0
        """Its port."""

    @property
    def uri(self) -> str:
        return f"udp://{HOST}:{self.port}"

    async def listen(self, port: int) -> None:
        """Listen at a port; at any free one for 0 or one that is taken."""
        self.talked = asyncio.get_running_loop().time()
        self._transport, self.port = await listen(self, HOST, port)

    def close(self) -> None:
        if self._transport is not None:
            self._transport.close()
            self._transport = None

    def datagram_received(self, data: bytes, addr: Address) -> None:
        loop = asyncio.get_running_loop()
        self.talked = loop.time()
        if self.air.loses():
            return
        if self.air.latency > 0.0:
            loop.call_later(self.air.latency, self._receive, data, addr)
        else:
            self._receive(data, addr)

    def _receive(self, data: bytes, addr: Address) -> None:
        if data == NULL:  # a scan for drones, and no client yet
            if self.drone.answers:
                self._sendto(NULL, addr)
            return
        self._client = addr
        self.drone.receive(data, asyncio.get_running_loop().time())

    def _send(self, raw: bytes) -> None:
        if self._client is None or self.air.loses():
            return
        if self.air.latency > 0.0:
            loop, client = asyncio.get_running_loop(), self._client
            loop.call_later(self.air.latency, self._sendto, raw, client)
        else:
            self._sendto(raw, self._client)

    def _sendto(self, raw: bytes, client: Address) -> None:
        if self._transport is not None:
            self._transport.sendto(raw, client)


class Server:
    """Simulated drones; to be started and closed in a running loop."""

    def __init__(self, builds: Sequence[Build], log: FlightLog, world: World = EMPTY_WORLD) -> None:
        self._log = log
        self._world = world
        self.endpoints = {build.id: Endpoint(build, log, world) for build in builds}
        """The drones by their ids."""
        self._ticking: asyncio.Task[None] | None = None

    async def start(self, ports: Mapping[str, int] | None = None) -> None:
        """Start drones at the given ports or free ones, and their clock."""
        for id, endpoint in self.endpoints.items():
            await endpoint.listen((ports or {}).get(id, 0))
        self._ticking = asyncio.create_task(self._tick())

    async def join(self, build: Build) -> None:
        """Add a drone to those that run, at a free port, unless it is there."""
        if build.id not in self.endpoints:
            endpoint = Endpoint(build, self._log, self._world)
            await endpoint.listen(0)
            self.endpoints[build.id] = endpoint

    @property
    def uris(self) -> dict[str, str]:
        return {id: endpoint.uri for id, endpoint in self.endpoints.items()}

    @property
    def drones(self) -> Mapping[str, SimulatedCrazyflie]:
        return {id: endpoint.drone for id, endpoint in self.endpoints.items()}

    @property
    def airborne(self) -> bool:
        return any(one.drone.body.airborne for one in self.endpoints.values())

    @property
    def quiet(self) -> float:
        """Seconds since the last packet to any of them."""
        last = max(one.talked for one in self.endpoints.values())
        return asyncio.get_running_loop().time() - last

    async def let(self, id: str, name: str, value: Value = True) -> None:
        """Set a fault of a drone; `gone` closes its port, or opens it again."""
        endpoint = self.endpoints[id]
        if name != "gone":
            let(endpoint.drone, endpoint.air, name, value)
        elif value:
            endpoint.close()
        else:
            await endpoint.listen(endpoint.port)

    async def close(self) -> None:
        if self._ticking is not None:
            self._ticking.cancel()
            await asyncio.gather(self._ticking, return_exceptions=True)
        for endpoint in self.endpoints.values():
            endpoint.close()

    async def _tick(self) -> None:
        loop = asyncio.get_running_loop()
        while True:
            now = loop.time()
            for endpoint in self.endpoints.values():
                endpoint.drone.step(now)
            collide(self.drones.values())
            await asyncio.sleep(_TICK)


def collide(drones: Iterable[SimulatedCrazyflie]) -> None:
    """Make drones tumble that touch in the air."""
    flying = [drone for drone in drones if drone.body.motors]
    for one, other in combinations(flying, 2):
        if dist(one.body.position, other.body.position) < _TOUCH:
            for drone in (one, other):
                drone.note("collision")
                drone.body.tumbled = True
                drone.body.cut()
