"""How much longer each phase of a flight takes than its trajectory: what `CRAZYFLIE` in `domain/motion.py` says.

    python -m tests.prediction.phases
    python -m tests.prediction.phases --drones 8 --times 2

Simulated Crazyflies fly side by side in virtual time, through cflib and by the team's own commands; their
record says how long each trajectory was planned to take.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import mean, stdev
from tempfile import mkdtemp
from typing import Any

from pluto_fleet.crtp.drone import EMPTY_WORLD, Build
from pluto_fleet.crtp.equipment import camera, fitted, port_of
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones import commands
from pluto_fleet.drones.vehicle import Cargo, Vehicle
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.shared.domain.actions import BUILT_IN, PICK, RELEASE
from pluto_fleet.shared.domain.model import Category, Item
from tests.kit.campaign import Campaign
from tests.kit.unthreaded import in_virtual_time, passes, the_air
from tests.library.crazyflie.hangar import navigation

SPEEDS = (0.3, 0.5, 1.0)
HEIGHTS = (0.5, 1.0, 1.6)
LENGTHS = (0.3, 1.0, 3.0)
PAUSES = (0.0, 2.0, 4.0)
"""Seconds between a landing and the next take-off: three seconds after it the drone has disarmed."""
ENDURING = 1e6
"""Seconds that a battery lasts that is no matter here."""
_ITEM = Item(name="pills", mass=0.008)


@dataclass(slots=True)
class Craft:
    """One drone with what flies it, and what each phase took besides its trajectory."""

    vehicle: Vehicle
    log: FlightLog
    home: tuple[float, float, float]
    beside: dict[str, list[float]] = field(default_factory=dict)

    async def took(
        self, phase: str, command: Coroutine[Any, Any, object], what: str, planned: float = 0.0
    ) -> None:
        """Await a command; note how much longer it took than it was planned to."""
        recorded, began = len(self.log.commands), the_air().time()
        await command
        seconds = the_air().time() - began
        for record in self.log.commands[recorded:]:
            if record.drone == self.vehicle.id and record.what == what:
                planned = record.values["duration"]
                before = max(0.0, record.time - began)
                self._note(f"{phase}: before", before)
                seconds -= before
        self._note(f"{phase}: after", seconds - planned)

    def _note(self, phase: str, seconds: float) -> None:
        self.beside.setdefault(phase, []).append(seconds)

    async def fly(self) -> None:
        """Fly all phases once."""
        x, y, _ = self.home
        for speed in SPEEDS:
            self.vehicle.speed, self.vehicle.climb = speed, min(0.6, speed)
            for height, pause in zip(HEIGHTS, PAUSES, strict=True):
                await passes(pause)
                up = self.vehicle.does("take off", commands.take_off, height)
                await self.took(f"take-off, {pause:g} s after a landing", up, "takeoff")
                for length in LENGTHS:
                    for place in ((x + length, y, height), (x, y, height)):
                        leg = self.vehicle.does("fly", commands.go_to, place)
                        await self.took(f"{length:g} m at {speed:g} m/s", leg, "go_to")
                await self._act()
                await self.took("landing", self.vehicle.does("land", commands.land), "land")

    async def _act(self) -> None:
        for action in BUILT_IN:
            item = _ITEM if action in (PICK, RELEASE) else None
            given = {"quantity": "temperature"} if action == "measure" else {}
            done = self.vehicle.does(action, commands.act, action, given, item)
            await self.took(action, done, "", BUILT_IN[action].seconds)


async def measured(drones: int, times: int) -> dict[str, list[float]]:
    """Return the seconds of each phase besides what was planned."""
    log = FlightLog()
    folder = Path(mkdtemp(prefix="phases-"))
    homes = [(1.0, 4.0 * place, 0.0) for place in range(drones)]
    builds = [
        Build(id=f"cf{place}", home=home, seed=place, flight=ENDURING)
        for place, home in enumerate(homes)
    ]
    server = Server(builds, log)
    await server.start()
    streamer = await camera()
    options = fitted({}, f"127.0.0.1:{port_of(streamer)}", EMPTY_WORLD)
    crafts = [
        Craft(_vehicle(build, server.uris[build.id], options, folder / build.id), log, build.home)
        for build in builds
    ]
    try:
        await asyncio.gather(*(one.vehicle.navigation.connect() for one in crafts))
        for one in crafts:
            one.vehicle.linked = True
        await asyncio.gather(*(_times(times, one.fly) for one in crafts))
    finally:
        await asyncio.gather(*(one.vehicle.navigation.close() for one in crafts))
        await server.close()
        streamer.close()
    phases = dict.fromkeys(phase for one in crafts for phase in one.beside)
    return {phase: [s for one in crafts for s in one.beside.get(phase, ())] for phase in phases}


def _vehicle(build: Build, uri: str, options: dict[str, object], folder: Path) -> Vehicle:
    folder.mkdir(parents=True)
    category = Category(name="measured", flight_time=ENDURING)
    drone = FleetDrone(id=build.id, category=category, home=build.home)
    flown = navigation(build, uri, folder, options)
    return Vehicle(drone, flown, Cargo(folder, print), print, the_air().time)


async def _times(times: int, fly: Callable[[], Coroutine[Any, Any, None]]) -> None:
    for _ in range(times):
        await fly()


def table(phases: dict[str, list[float]]) -> Iterator[str]:
    """Yield a table in Markdown."""
    yield "| seconds besides the trajectory | n | mean | s.d. | least | most |"
    yield "| --- | ---: | ---: | ---: | ---: | ---: |"
    for phase, seconds in sorted(phases.items()):
        figures = mean(seconds), stdev(seconds), min(seconds), max(seconds)
        yield f"| {phase} | {len(seconds)} | {' | '.join(f'{one:.3f}' for one in figures)} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and print."""
    campaign = Campaign("tests.prediction.phases", __doc__)
    campaign.option("--drones", type=int, default=8, metavar="N", help="side by side (8)")
    campaign.option("--times", type=int, default=1, metavar="N", help="all phases N times (1)")
    options = campaign.parse(arguments)
    print("\n".join(table(in_virtual_time(measured(options.drones, options.times)))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
