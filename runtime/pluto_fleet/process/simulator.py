"""Simulated drones in a process of their own, which outlives the program that flies them, as real ones would.

It ends when all are on the ground and no packet has come for a while. What it keeps in its folder is its own: when it
is started again, drones stand where they were, behind the same ports if those are still free.
"""

from __future__ import annotations

import asyncio
import fcntl
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from ..shared.domain.errors import BadInput
from . import locks, respawn
from .forked import deaf, in_children, not_for_children
from .ipc import NotRunning, answering, ask, listening

GATEWAY_LOCK = "lock"
"""The lock file of the flight's gateway in this folder."""
_IDLE = 60.0
"""Seconds without a drone in the air and without a packet, after which it ends."""
_PATIENCE = 10.0
"""The time-out of a start or an answer, in seconds."""
_LOOK = 1.0


async def listen(
    packets: asyncio.DatagramProtocol, host: str, port: int
) -> tuple[asyncio.DatagramTransport, int]:
    """Listen at a port; at any free one for 0, or one that is taken; return that port as well."""
    loop = asyncio.get_running_loop()
    try:
        made = await loop.create_datagram_endpoint(lambda: packets, local_addr=(host, port))
    except OSError:
        made = await loop.create_datagram_endpoint(lambda: packets, local_addr=(host, 0))
    transport, _ = made
    return transport, transport.get_extra_info("sockname")[1]


class Server(Protocol):
    """What simulated drones are reached through."""

    @property
    def uris(self) -> Mapping[str, str]:
        """How each is reached, by its name."""

    @property
    def quiet(self) -> float:
        """Seconds since the last packet."""

    @property
    def airborne(self) -> bool:
        """Whether one is above the ground."""


class Served(Protocol):
    """Simulated drones, and what other processes ask of them."""

    @property
    def server(self) -> Server:
        """What they are reached through."""

    async def start(self) -> None:
        """Listen for packets."""

    async def answer(self, request: Mapping[str, object]) -> str:
        """Answer a request; raise `BadInput` if it is refused."""

    def keep(self) -> None:
        """Write down where they are."""

    async def close(self) -> None:
        """Let go of all that is open, and write down where they are."""


@dataclass(frozen=True, slots=True)
class Simulator:
    """One kind of simulated drones: how its process is started, asked and ended."""

    name: str
    """The command of the library's program that runs it; its files begin with it."""
    drones: str
    """What messages call them."""
    _started: dict[Path, subprocess.Popen[bytes]] = field(default_factory=dict)
    """The processes started by this one, by folder; reaped by `end`."""

    def start(self, folder: Path, command: Sequence[str] | None = None) -> dict[str, str]:
        """Start its process in a folder; return the drones' URIs, or raise `BadInput` if it does not start.

        `command` starts it, with the folder appended; default: the library's own program.
        """
        log = folder / f"{self.name}.log"
        process = respawn.start([*(command or respawn.library(self.name)), str(folder)], log)
        self._started[folder] = process
        until = time.monotonic() + _PATIENCE
        while time.monotonic() < until and process.poll() is None:
            with suppress(NotRunning):
                return self.uris_in(folder)
            time.sleep(0.01)
        raise BadInput(f"the {self.drones} did not start; what they said is in {log}")

    def uris_in(self, folder: Path) -> dict[str, str]:
        """Return the drones' URIs; raise `BadInput` if none run for this folder."""
        uris: dict[str, str] = json.loads(self.told(folder, "uris"))
        return uris

    def told(self, folder: Path, do: str, **more: object) -> str:
        """Send a request to the drones of a folder; raise `BadInput` if it is refused.

        All know `uris` and `end`.
        """
        return ask(folder / self.name, {"do": do, **more}, _PATIENCE)

    def end(self, folder: Path) -> None:
        """End the drones of a folder, if there are any."""
        until = time.monotonic() + _PATIENCE
        with suppress(BadInput):
            while time.monotonic() < until:
                self.told(folder, "end")
                time.sleep(0.02)
        process = self._started.pop(folder, None)
        if process is not None:
            process.wait(_PATIENCE)

    def main(self, arguments: Sequence[str], needed: str, served: Callable[[Path], Served]) -> int:
        """Run the drones of a folder, which has the file `needed`, until they are not needed."""
        folder = Path(*arguments[:1])
        if len(arguments) != 1 or not os.path.isfile(folder / needed):
            by_itself = "an app starts this by itself when it flies; there is nothing to do by hand"
            print(f"{self.name}: {by_itself}", file=sys.stderr)
            return 2
        with (folder / f"{self.name}.lock").open("a") as lock:
            not_for_children(lock.fileno())
            fcntl.flock(lock, fcntl.LOCK_EX)  # another one is ending
            asyncio.run(self._run(folder, served))
        return 0

    async def _run(self, folder: Path, served: Callable[[Path], Served]) -> None:
        drones = served(folder)
        server = drones.server
        over = asyncio.Event()

        async def answer(request: Mapping[str, object]) -> str:
            match request:
                case {"do": "uris"}:
                    return json.dumps(server.uris)
                case {"do": "end"}:
                    over.set()
                    return "it ends"
            return await drones.answer(request)

        for number in (signal.SIGTERM, signal.SIGINT):
            asyncio.get_running_loop().add_signal_handler(number, over.set)
        no_more = in_children(deaf)
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            await drones.start()
            async with listening(folder / self.name, answering(answer)):
                while not over.is_set():
                    drones.keep()
                    # while this folder's gateway runs, drones on the ground still tell how they are
                    is_flown = locks.is_taken(folder / GATEWAY_LOCK)
                    if server.quiet > _IDLE and not server.airborne and not is_flown:
                        break
                    with suppress(TimeoutError):
                        async with asyncio.timeout(_LOOK):
                            await over.wait()
        finally:
            no_more()
            await drones.close()
