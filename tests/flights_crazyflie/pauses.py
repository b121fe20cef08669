"""Lands simulated Crazyflies and lets them take off again, after pauses of any length.

    python -m tests.flights_crazyflie.pauses
    python -m tests.flights_crazyflie.pauses --first 2.8 --last 3.3 --step 0.01 --drones 30
    python -m tests.flights_crazyflie.pauses --auto-arm

flies 301 pauses, from 0 to 6 s in steps of 20 ms, by the unmodified cflib and in virtual time; many drones share
them.
Some 3 s after a landing the firmware disarms by itself: a take-off must outlive that at any moment.
Judged is by the drones' own record: each pause is followed by a take-off that is flown, and a landing.
"""

from __future__ import annotations

import asyncio
import sys
import time
from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.errors import NavigationError
from pluto_fleet.drones.protocol import DroneSetup
from tests.flights_crazyflie.judge import dropped
from tests.kit.unthreaded import in_virtual_time

FIRST, LAST, STEP, DRONES = 0.0, 6.0, 0.02, 24
HEIGHT, SPEED = 0.3, 1.0
_NEAR = 0.15
"""Metres from that height within which a drone hovers after its take-off."""
_PATIENCE = 60.0
"""Seconds until a drone that does not get on is given up."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one pause."""

    pause: float
    """Seconds from the landing to the next take-off."""
    wrong: str
    """Empty: it flew."""


def pauses(first: float = FIRST, last: float = LAST, step: float = STEP) -> list[float]:
    """Return the pauses to be flown."""
    return [first + step * number for number in range(round((last - first) / step) + 1)]


async def sweep(
    wanted: Sequence[float], drones: int, folder: Path, *, auto_arm: bool = False
) -> list[Outcome]:
    """Share these pauses among so many drones, and fly them all at once; return what became of each."""
    builds = [
        Build(id=f"cf{number}", home=(2.0 * number, 0.0, 0.0), auto_arm=auto_arm, seed=number)
        for number in range(min(drones, len(wanted)))
    ]
    record = MemoryLog()
    server = Server(builds, record)
    await server.start()
    try:
        flown = await asyncio.gather(
            *(
                _chain(server, record, build, wanted[number :: len(builds)], folder)
                for number, build in enumerate(builds)
            )
        )
    finally:
        await server.close()
    return sorted((one for chain in flown for one in chain), key=lambda one: one.pause)


async def _chain(
    server: Server, record: MemoryLog, build: Build, wanted: Sequence[float], folder: Path
) -> list[Outcome]:
    """Fly some pauses with one drone, one after the other."""
    flies = Crazyflie(
        DroneSetup(
            id=build.id,
            uri=server.uris[build.id],
            home=build.home,
            speed=SPEED,
            options={"least_voltage": 0.0},
            folder=folder,
        )
    )
    outcomes: list[Outcome] = []
    try:
        await flies.connect()
        await _up_and_down(server, flies, build.id)
        for pause in wanted:
            await asyncio.sleep(pause)
            before = len(record.commands)
            try:
                async with asyncio.timeout(_PATIENCE):
                    wrong = await _up_and_down(server, flies, build.id)
            except (NavigationError, TimeoutError) as error:
                wrong = str(error) or "it does not get on"
            fell = [command for command in record.commands[before:] if command.drone == build.id]
            outcomes.append(Outcome(pause, wrong or "; ".join(dropped(fell))))
    except NavigationError as error:
        outcomes += [Outcome(pause, f"not flown: {error}") for pause in wanted[len(outcomes) :]]
    finally:
        await flies.close()
    return outcomes


async def _up_and_down(server: Server, flies: Crazyflie, id: str) -> str:
    """Take off, and land; return what was wrong about where the drone really was."""
    await flies.takeoff(HEIGHT, SPEED)
    height = server.drones[id].body.position[2]
    await flies.land(SPEED / 2.0)
    if abs(height - HEIGHT) > _NEAR:
        return f"it was {height:.2f} m high after its take-off"
    return "it has not landed" if server.drones[id].body.airborne else ""


def main() -> int:
    """Fly them all; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.flights_crazyflie.pauses", description=__doc__)
    for name, default, what in (
        ("--first", FIRST, "the shortest pause, in seconds"),
        ("--last", LAST, "the longest"),
        ("--step", STEP, "between two pauses"),
    ):
        parser.add_argument(name, type=float, default=default, metavar="S", help=what)
    parser.add_argument(
        "--drones", type=int, default=DRONES, metavar="N", help="how many fly at once"
    )
    parser.add_argument(
        "--auto-arm", action="store_true", help="drones that arm by themselves, and not on request"
    )
    options = parser.parse_args()
    wanted = pauses(options.first, options.last, options.step)
    if not wanted or options.drones < 1:
        parser.error("there is nothing to fly")
    began = time.monotonic()
    with TemporaryDirectory(prefix="pauses-") as folder:
        flights = sweep(wanted, options.drones, Path(folder), auto_arm=options.auto_arm)
        outcomes = in_virtual_time(flights)
    bad = [one for one in outcomes if one.wrong]
    for one in bad:
        print(f"{one.pause:.2f} s: {one.wrong}")
    took = time.monotonic() - began
    print(f"{len(outcomes) - len(bad)} of {len(outcomes)} pauses were flown in {took:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
