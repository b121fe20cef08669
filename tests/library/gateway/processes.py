"""A gateway over a small simulated world, and a brain that talks to it through its socket.

`played` starts the gateway as a process of its own, in which time passes fast; `played_inside` runs all that
the process does in this one, on a loop whose clock jumps.
"""

from __future__ import annotations

import asyncio
import json
import os
import signal
import sys
from collections.abc import Awaitable, Callable, Coroutine
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import pluto_fleet
from pluto_fleet.gateway.process import LOCK, NOTE, run
from pluto_fleet.gateway.settings import Settings
from pluto_fleet.gateway.starting import connect
from pluto_fleet.gateway.wire import MAX_REPORT
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.jobs.link import Link
from pluto_fleet.process import ipc
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.time.kernel import FLEET, Future
from pluto_fleet.simulation.world_store import DEEDS
from tests.kit import drones
from tests.library.gateway.flights import SCOUT, Commander, Task

T = TypeVar("T")

SPEED = 100.0

PROGRAM = (
    f"import sys; sys.path.insert(0, {str(Path(pluto_fleet.__path__[0]).parent)!r}); "
    "from pluto_fleet.gateway.process import main; sys.exit(main(sys.argv[1:]))"
)
COMMAND = (sys.executable, "-c", PROGRAM)


def settings(**other: Any) -> Settings:
    """Return settings for two drones at (1, 1) and (2, 1)."""
    drones = tuple(
        FleetDrone(id=f"cf{i + 1}", category=SCOUT, home=(1.0 + i, 1.0, 0.0), index=i)
        for i in range(2)
    )
    given: dict[str, Any] = {
        "drones": drones,
        "airspace": Airspace(),
        "apart": 0.5,
        "world": None,
        "seed": 1,
        "faults": Faults(),
        "speed": SPEED,
        "patience": 1.0,
        "idle": 1.0,
    }
    return Settings(**{**given, **other})


class Brain:
    """What commands the gateway of a folder, and may hang up at any time."""

    def __init__(self, kernel: RealTime, folder: Path, **other: Any) -> None:
        self.kernel, self.folder, self._settings = kernel, folder, settings(**other)
        self.lost: Future[None] = Future()
        self.epoch = 0
        self.links: list[Link] = []

    def pass_at(self, speed: float) -> None:
        """Let the next link ask for another speed of time."""
        self._settings = replace(self._settings, speed=speed)

    async def linked(self) -> Commander:
        """Link to the gateway; start one if there is none."""
        self.epoch += 1
        self.lost = lost = Future[None]()
        link = await connect(
            self.folder, self._settings, self.kernel, self.epoch, lambda: lost.set(None), COMMAND
        )
        self.links.append(link)
        return Commander(link)

    async def told(self, ask: Coroutine[Any, Any, T]) -> T:
        """Run what waits for an answer on the kernel, and return the answer."""
        return await self.kernel.run(self.kernel.spawn(ask, FLEET, "the brain"))

    async def flown(self, link: Commander, job: Task) -> object:
        ended: Future[object] = Future()
        self.kernel.post(link.fly, job, ended.set)
        return await self.kernel.run(ended)

    async def until(self, is_so: Callable[[], bool]) -> None:
        async with asyncio.timeout(60):
            while not is_so():
                await asyncio.sleep(0.005)


class InsideBrain(Brain):
    """One whose gateway runs in this process."""

    gateway: asyncio.Task[None] | None = None

    async def linked(self) -> Commander:
        await self.begins()
        return await super().linked()

    async def begins(self) -> None:
        if not self.gateway_runs:
            self.gateway = asyncio.create_task(run(self.folder, self._settings))
            await self.until(lambda: ipc.address_in(self.folder / NOTE) is not None)

    @property
    def gateway_runs(self) -> bool:
        return self.gateway is not None and not self.gateway.done()

    async def tells(self, *lines: bytes) -> list[dict[str, Any]]:
        """Send lines through a connection of its own, hang up, and return all answers but telemetry."""
        reader, writer = await ipc.connect(self.folder / NOTE, MAX_REPORT)
        writer.writelines(lines)
        writer.write_eof()
        answers = [json.loads(answer) for answer in (await reader.read()).splitlines()]
        writer.close()
        return [answer for answer in answers if set(answer) != {"seen"}]

    async def ends(self) -> None:
        if self.gateway is not None:
            self.gateway.cancel()
            await asyncio.wait([self.gateway])


def played_inside(
    folder: Path, play: Callable[[InsideBrain], Awaitable[None]], **other: Any
) -> None:
    """Let a brain play its part, with a gateway in this process, in virtual time."""

    async def main() -> None:
        brain = InsideBrain(RealTime(SPEED), folder, **other)
        try:
            await play(brain)
        finally:
            for link in brain.links:
                await link.close()
            await brain.ends()

    hangs_up = signal.getsignal(signal.SIGHUP)
    try:
        drones.run(main())
    finally:
        signal.signal(signal.SIGHUP, hangs_up)


def played(folder: Path, play: Callable[[Brain], Awaitable[None]], **other: Any) -> None:
    """Let a brain play its part, and leave no gateway behind."""

    async def main() -> None:
        brain = Brain(RealTime(SPEED), folder, **other)
        try:
            async with asyncio.timeout(150):
                await play(brain)
        finally:
            for link in brain.links:
                await link.close()
            with_pid = pid(folder)
            if with_pid is not None:
                os.kill(with_pid, 9)

    asyncio.run(main())


def pid(folder: Path) -> int | None:
    """Return the number of the gateway's process, if it runs."""
    try:
        number = int((folder / LOCK).read_text())
        os.kill(number, 0)
        stat = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()
    except (OSError, ValueError):
        return None
    return None if stat[0] == "Z" else number


def deeds(folder: Path) -> list[tuple[str, str, str]]:
    """Return what was done in the world: drone, action, job."""
    return [
        (deed["drone"], deed["action"], deed["job"])
        for deed in map(json.loads, (folder / DEEDS).read_text().splitlines())
    ]
