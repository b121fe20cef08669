"""Many simulated drones in one loop, a UDP port each: `udp://127.0.0.1:PORT` reaches one."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from math import dist
from random import Random
from typing import Any

from ..shared.alone.world import World
from .drone import EMPTY_WORLD, Build, SimulatedCrazyflie
from .faults import Value, let
from .flight_log import FlightLog
from .packets import NULL, LossyChannel

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
        """Its URI."""
        return f"udp://{HOST}:{self.port}"

    async def listen(self, port: int) -> None:
        """Listen at a port; at any free one for 0 or one that is taken."""
        loop = asyncio.get_running_loop()
        self.talked = loop.time()
        try:
            made = await loop.create_datagram_endpoint(lambda: self, local_addr=(HOST, port))
        except OSError:
            made = await loop.create_datagram_endpoint(lambda: self, local_addr=(HOST, 0))
        self._transport, _ = made
        self.port = self._transport.get_extra_info("sockname")[1]

    def close(self) -> None:
        """Close the port, so that clients see it closed."""
        if self._transport is not None:
            self._transport.close()
            self._transport = None

    def datagram_received(self, data: bytes, addr: Address) -> None:
        """Process a packet, unless it is lost."""
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
        """Return their URIs."""
        return {id: endpoint.uri for id, endpoint in self.endpoints.items()}

    @property
    def drones(self) -> Mapping[str, SimulatedCrazyflie]:
        """The drones by their ids."""
        return {id: endpoint.drone for id, endpoint in self.endpoints.items()}

    @property
    def airborne(self) -> bool:
        """Whether a drone is in the air."""
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
        """Close everything."""
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
