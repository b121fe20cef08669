"""How long is the event loop held up by cflib, above all while drones are silent?

`python benchmarks/crazyflie.py` flies ten simulated Crazyflies, which live in a process of their own,
through cflib over UDP. One is silent when it is connected to, half of them fall silent in flight and
are reached again. It prints, for each part of that, the longest time in which the loop did nothing
else; 50 ms is what a navigation may take. The first row is a loop that only sleeps: what the machine
itself takes. Needs the extra `crazyflie`.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import subprocess
import sys
import tempfile
from collections.abc import Awaitable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import quantiles
from typing import IO

from measuring.options import at_least_one
from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.protocol import DroneSetup, NavigationError

TICK = 0.002
LIMIT = 0.050
SPEED = 1.0


def homes(drones: int) -> dict[str, tuple[float, float, float]]:
    """Return where each stands, a metre apart."""
    return {f"cf{number}": (float(number), 0.0, 0.0) for number in range(1, drones + 1)}


async def simulate(drones: int) -> None:
    """Be the other process: simulated drones, and a line `ID FAULT ON` for what goes wrong."""
    builds = [Build(id=id, home=home) for id, home in homes(drones).items()]
    server = Server(builds, FlightLog())
    await server.start()
    print(json.dumps(server.uris), flush=True)
    loop = asyncio.get_running_loop()
    while line := await loop.run_in_executor(None, sys.stdin.readline):
        drone, fault, on = line.split()
        await server.let(drone, fault, on == "True")
    await server.close()


@contextmanager
def simulated(drones: int) -> Iterator[tuple[dict[str, str], IO[str]]]:
    """Start that process; yield the drones' URIs and where faults are written to."""
    command = [sys.executable, __file__, "--simulate", "--drones", str(drones)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None and process.stdout is not None
        yield json.loads(process.stdout.readline()), process.stdin
        process.stdin.close()


@dataclass(slots=True)
class Pulse:
    """A task that wants to run every two milliseconds, and how much later it did."""

    late: list[float]

    async def beat(self) -> None:
        """Beat until it is cancelled."""
        loop = asyncio.get_running_loop()
        while True:
            due = loop.time() + TICK
            await asyncio.sleep(TICK)
            self.late.append(loop.time() - due)


Row = tuple[str, float, float]


async def measured(what: str, doing: Awaitable[object]) -> Row:
    """Return the longest and the usual time that the loop was held up meanwhile."""
    pulse = Pulse([])
    beating = asyncio.create_task(pulse.beat())
    await doing
    beating.cancel()
    return what, max(pulse.late), quantiles(pulse.late, n=100, method="inclusive")[98]


async def all_of(doing: Sequence[Awaitable[object]]) -> None:
    """Wait for all, also where one fails."""
    for outcome in await asyncio.gather(*doing, return_exceptions=True):
        if isinstance(outcome, Exception) and not isinstance(outcome, NavigationError):
            raise outcome


async def fly(drones: int, uris: dict[str, str], faults: IO[str], folder: Path) -> list[Row]:
    """Return a row for each part of the flight."""

    def let(names: Sequence[str], on: bool) -> None:
        for name in names:
            print(name, "silent", on, file=faults, flush=True)

    def away(name: str) -> tuple[float, float, float]:
        return homes(drones)[name][0], 3.0, 1.0

    flown = {
        id: Crazyflie(
            DroneSetup(
                id=id, uri=uri, home=homes(drones)[id], speed=SPEED, options={}, folder=folder
            )
        )
        for id, uri in uris.items()
    }
    names = list(flown)
    half = names[: (drones + 1) // 2]
    rows = [await measured("nothing at all", asyncio.sleep(3.0))]
    let(names[:1], True)
    connecting = all_of([one.connect() for one in flown.values()])
    rows.append(await measured("import cflib; connect, one is silent", connecting))
    let(names[:1], False)
    rows.append(await measured("connect to that one again", flown[names[0]].connect()))
    ups = all_of([one.takeoff(1.0, SPEED) for one in flown.values()])
    rows.append(await measured("take off", ups))
    going = asyncio.ensure_future(all_of([flown[name].go_to(away(name), SPEED) for name in names]))
    await asyncio.sleep(1.0)
    let(half, True)
    rows.append(await measured("fly, half of them fall silent", going))
    again = all_of([flown[name].connect() for name in half])
    rows.append(await measured("connect to the silent half", again))
    let(half, False)
    again = all_of([flown[name].connect() for name in half])
    rows.append(await measured("connect to it when it answers", again))
    rows.append(await measured("land", all_of([one.land(SPEED) for one in flown.values()])))
    rows.append(await measured("close", all_of([one.close() for one in flown.values()])))
    return rows


def main() -> int:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(description="How long cflib holds up the event loop")
    parser.add_argument("--drones", type=at_least_one, default=10)
    parser.add_argument("--simulate", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.simulate:
        asyncio.run(simulate(options.drones))
        return 0
    with tempfile.TemporaryDirectory() as folder, simulated(options.drones) as (uris, faults):
        rows = asyncio.run(fly(options.drones, uris, faults, Path(folder)))
    print(f"{options.drones} drones; milliseconds that the loop was held up")
    print(f"{'':40}{'longest':>10}{'99 of 100':>12}")
    for what, longest, usual in rows:
        print(f"{what:40}{longest * 1000:10.1f}{usual * 1000:12.1f}")
    worst = max(longest for _, longest, _ in rows)
    print("never more than 50 ms" if worst <= LIMIT else f"{worst * 1000:.0f} ms: too long")
    return 0 if worst <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
