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
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.errors import NavigationError
from tests.flights_crazyflie.judge import dropped
from tests.kit.campaign import Campaign
from tests.kit.unthreaded import in_virtual_time, passes
from tests.library.crazyflie.hangar import navigation

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


def pauses(first: float, last: float, step: float) -> list[float]:
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
    flies = navigation(build, server.uris[build.id], folder, {"least_voltage": 0.0}, SPEED)
    outcomes: list[Outcome] = []
    try:
        await flies.connect()
        await _up_and_down(server, flies, build.id)
        for pause in wanted:
            await passes(pause)
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


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly them all; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_crazyflie.pauses", __doc__)
    campaign.option("--first", type=float, default=0.0, help="the shortest pause, in seconds")
    campaign.option("--last", type=float, default=6.0, help="the longest")
    campaign.option("--step", type=float, default=0.02, help="between two pauses")
    campaign.option("--drones", type=int, default=24, help="how many fly at once")
    what = "drones that arm by themselves, and not on request"
    campaign.option("--auto-arm", action="store_true", help=what)
    options = campaign.parse(arguments)
    wanted = pauses(options.first, options.last, options.step)
    with TemporaryDirectory(prefix="pauses-") as folder:
        flights = sweep(wanted, options.drones, Path(folder), auto_arm=options.auto_arm)
        outcomes = in_virtual_time(flights)
    for one in outcomes:
        if one.wrong:
            campaign.found(f"a pause of {one.pause:.2f} s", one.wrong)
    return campaign.over(f"{len(outcomes)} pauses were flown")


if __name__ == "__main__":
    sys.exit(main())
