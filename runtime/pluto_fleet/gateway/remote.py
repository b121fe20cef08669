"""The brain's link to a gateway in another process: its orders go over a socket, as they are."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING, Any

from ..jobs.link import Link
from ..process.ipc import line, message_in
from ..shared.domain.errors import BadInput

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

    from ..jobs.link import Order
    from ..jobs.telemetry import Telemetry
    from ..process.ipc import Message
    from ..shared.domain.model import Point
    from ..shared.time.kernel import Kernel

GATEWAY_TIMEOUT = 5.0
"""Seconds of real time without a message after which the gateway is lost."""


class RemoteTelemetry:
    """A drone's latest telemetry."""

    __slots__ = ("_silent_since", "battery_level", "landed", "location", "moves")

    def __init__(self) -> None:
        self.location: Point = (0.0, 0.0, 0.0)
        self.battery_level, self.landed = 0.0, True
        self.moves = False
        """Whether it carries out a command."""
        self._silent_since: float | None = 0.0

    def take(self, told: Sequence[Any]) -> None:
        """Take over new telemetry."""
        x, y, z, self.battery_level, self.landed, self.moves, *since = told
        self.location = x, y, z
        self._silent_since = since[0] if since else None

    @property
    def silence(self) -> float:
        """Seconds since the drone's last message to the gateway; infinite: it has sent none."""
        since = self._silent_since
        return 0.0 if since is None else inf if not since else max(0.0, time.time() - since)


class RemoteLink(Link):
    """Commands drones through a gateway in another process.

    When that cannot be reached any more, `lost` is called, once, and nothing is heard ever after.
    """

    def __init__(
        self,
        kernel: Kernel,
        reader: StreamReader,
        writer: StreamWriter,
        lost: Callable[[], object] | None,
    ) -> None:
        super().__init__()
        self._kernel, self._reader, self._writer, self._lost = kernel, reader, writer, lost
        self._drones: dict[str, RemoteTelemetry] = {}
        self._is_lost = False
        self._heard = 0.0
        self._tasks: list[asyncio.Task[None]] = []

    async def link(self, epoch: int, patience: float, speed: float = 1.0) -> None:
        """Take command; raise `BadInput` if another brain has done so meanwhile.

        `speed`: how fast time passes from now on, if the drones are simulated.
        """
        self.send({"do": "link", "epoch": epoch, "speed": float(speed)})
        told = message_in(await self._reader.readline())
        match told:
            case {"linked": dict(drones)}:
                self._see(drones)
            case {"ok": False, "said": str(why)}:
                raise BadInput(why)
            case _:
                raise ConnectionError("the gateway ended before it had answered")
        self._tasks = [
            asyncio.ensure_future(self._read()),
            asyncio.ensure_future(self._live(patience / 6)),
        ]

    async def _read(self) -> None:
        """Read messages of the gateway until the connection ends."""
        loop = asyncio.get_running_loop()
        self._heard = loop.time()
        with suppress(Exception):  # an invalid message: the line is broken
            while told := await self._reader.readline():
                self._heard = loop.time()
                message = message_in(told)
                if message is None or "lost" in message:
                    break
                told_of = dict(message)
                self._see(told_of.pop("seen", {}))
                self.seen()
                if told_of:
                    self._kernel.post(self.take, told_of)
        self._end()

    async def _live(self, each: float) -> None:
        """Send heartbeats, and notice when the gateway is silent."""
        loop, late = asyncio.get_running_loop(), 0
        while not self._is_lost:
            self.send({"do": "heartbeat"})
            await asyncio.sleep(each)
            late = late + 1 if loop.time() - self._heard > GATEWAY_TIMEOUT else 0
            if late > 1:  # only if late twice in a row: its messages may be waiting to be read
                self._writer.transport.abort()

    def _end(self) -> None:
        if self._is_lost:
            return
        self._is_lost = True
        with suppress(OSError):
            self._writer.close()
        if self._lost is not None:
            self._kernel.post(self._lost)

    def _see(self, drones: Message) -> None:
        for drone, told in drones.items():
            self._drones.setdefault(drone, RemoteTelemetry()).take(told)

    def send(self, order: Order) -> None:
        """Send an order, unless the gateway is lost."""
        if not self._is_lost and not self._writer.transport.is_closing():
            self._writer.write(line(order))

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._drones[drone]

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command, as far as the gateway has told."""
        return self._drones[drone].moves

    # The end

    async def goodbye(self) -> None:
        """Allow the gateway to exit once all drones have landed."""
        self._lost = None
        self.send({"do": "goodbye"})
        if self._tasks:
            await asyncio.wait(self._tasks[:1])
        await self.close()

    async def close(self) -> None:
        """Close the connection: the gateway goes on, and lands all drones unless another brain connects."""
        self._lost = None
        self._end()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        with suppress(OSError):
            await self._writer.wait_closed()
