"""How near does a Crazyflie stay to somebody who walks?

    python benchmarks/following.py

One simulated Crazyflie, flown through cflib behind a gateway, follows a person who walks around three corners of a
hall, at several speeds, for a minute each: twice a second it is told where that person will be in a second, by the last
two reports. In virtual time. Of the distance on the ground, every 0.05 s from when it has caught up, the median and the 95th percentile,
and for which share of the time it was slower than a third of the person. Ends with 1 if it was farther than `reach`, half
a metre, in the median.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from math import dist
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from pluto_fleet.crtp.body import Body
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.team import Team
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.shared.domain.airspace import Airspace, Corner
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.events.world import Mover
from tests.kit.unthreaded import in_virtual_time, the_air
from tests.library.crazyflie.hangar import navigation
from tests.library.drones.teams import Asked
from tests.library.gateway.flights import Commander

SPEEDS = (0.2, 0.3, 0.4, 0.5)
HALL = Airspace(size=(12.0, 8.0))
PATH: Sequence[Corner] = ((2.0, 7.5), (5.0, 5.0), (3.0, 2.0), (8.0, 3.0))
SCOUT = Category(name="scout", speed=1.0, flight_time=420, charge_time=1200)
LASTS = 60.0
CATCHES_UP = 5.0
AHEAD = 1.0
AGAIN = 0.5
LOOK = 0.05
REACH = 0.5


@dataclass(slots=True)
class Figures:
    """What was seen."""

    away: list[float] = field(default_factory=list)
    paces: list[float] = field(default_factory=list)


@dataclass(frozen=True, slots=True, kw_only=True)
class Flying:
    """A simulated Crazyflie in the air behind a gateway, and who commands it."""

    asked: Asked
    link: Commander
    body: Body
    clock: Callable[[], float]

    def go(
        self, number: int, stop: Point, seconds: float, over: Callable[[object], object]
    ) -> None:
        """Tell it where to be in so many seconds, 0: as soon as it can; `over` is called with what came of it."""
        self.link._reports[number] = over
        order = {"do": "go", "id": number, "drone": "cf1", "stops": [stop], "seconds": seconds}
        self.asked.kernel.post(self.link.link.send, order)


@asynccontextmanager
async def flying(home: Point, folder: Path) -> AsyncIterator[Flying]:
    """Have one Crazyflie hover where it was asked to fly first, and land it at the end."""
    build = Build(id="cf1", home=home)
    server = Server([build], FlightLog())
    await server.start()
    asked = Asked()
    clock = the_air().time
    drone = FleetDrone(id="cf1", category=SCOUT, home=build.home)
    flies = {"cf1": navigation(build, server.uris["cf1"], folder)}
    say = asked.log.append
    team = Team(asked.kernel, [drone], flies, HALL, folder=folder, say=say, clock=clock)
    gateway = Gateway(asked.kernel, team, [drone], HALL, apart=0.5, slack=CRAZYFLIE.slack)
    team.begin()
    link = Commander(gateway.link(1))
    await asked.do(link.fleet_report())
    try:
        yield Flying(asked=asked, link=link, body=server.drones["cf1"].body, clock=clock)
    finally:
        await team.close()
        await asyncio.sleep(0)
        await server.close()


async def followed(speed: float, folder: Path) -> Figures:
    """Follow a person at this speed."""
    walks = Mover(name="t1", kind="person", path=(*PATH,), speed=speed, repeat=True)
    async with flying((2.0, 7.0, 0.0), folder) as drone:
        await drone.asked.do(drone.link.goes("cf1", (*PATH[0], 1.2)))
        return await _followed(drone, walks)


async def _followed(drone: Flying, walks: Mover) -> Figures:
    clock = drone.clock
    body = drone.body
    figures = Figures()
    began = clock()

    def place(when: float) -> Corner:
        at = walks.at(max(0.0, when - began))
        assert at is not None
        return at

    for number in range(1000, 1000 + round(LASTS / AGAIN)):
        before = place(clock() - AGAIN)
        here = place(clock())
        x, y = (b + AHEAD * (b - a) / AGAIN for a, b in zip(before, here, strict=True))
        stop = min(max(x, 0.0), 12.0), min(max(y, 0.0), 8.0), 1.2
        drone.go(number, stop, AHEAD, lambda _: None)
        for _ in range(round(AGAIN / LOOK)):
            before = body.position[:2]
            await asyncio.sleep(LOOK)
            if clock() - began > CATCHES_UP:
                figures.away.append(dist(body.position[:2], place(clock())))
                figures.paces.append(dist(body.position[:2], before) / LOOK)
    return figures


def main() -> int:
    """Print a row for each speed."""
    argparse.ArgumentParser(
        description="How near a Crazyflie stays to a person who walks."
    ).parse_args()
    print("| it walks at, m/s | metres away: median | 95 % | hardly moves |")
    print("| ---: | ---: | ---: | ---: |")
    far = False
    for speed in SPEEDS:
        with TemporaryDirectory() as folder:
            figures = in_virtual_time(followed(speed, Path(folder)))
        away = sorted(figures.away)
        slow = sum(pace < speed / 3 for pace in figures.paces) / len(figures.paces)
        most = away[int(0.95 * len(away))]
        print(f"| {speed} | {median(away):.2f} | {most:.2f} | {100 * slow:.0f} % |", flush=True)
        far = far or median(away) > REACH
    return 1 if far else 0


if __name__ == "__main__":
    raise SystemExit(main())
