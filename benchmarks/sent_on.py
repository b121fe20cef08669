"""How long does a Crazyflie take to where it is sent while it flies somewhere else?

    python benchmarks/sent_on.py

One simulated Crazyflie of 1 m/s, flown through cflib behind a gateway, is sent elsewhere once it has flown for so many
seconds: on, aside and back. In virtual time. Printed is how long it takes until it hovers there, and what the model of
motion says, with how far they are from each other. Ends with 1 if that is more than half a second in the mean.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
from dataclasses import replace
from math import cos, radians, sin
from pathlib import Path
from statistics import fmean
from tempfile import TemporaryDirectory

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from following import HALL, SCOUT, Flying, flying
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.kit.unthreaded import in_virtual_time

HEIGHT = 1.2
HOME = (2.0, 4.0, 0.0)
FAR = (10.0, 4.0, HEIGHT)
AFTER = (0.7, 2.0, 4.0, 8.0)
METRES = (0.7, 1.5, 2.5)
SIDES = {"on": 0.0, "aside": 90.0, "back": 180.0}
LOOK = 0.02
LONGEST = 30.0
MOST = 0.5
EXACT = replace(CRAZYFLIE, spread=0.0)


async def sent_on(after: float, metres: float, degrees: float, folder: Path) -> tuple[float, float]:
    """Return the seconds that it takes, and those by the model of motion."""
    async with flying(HOME, folder) as drone:
        await drone.asked.do(drone.link.goes("cf1", (*HOME[:2], HEIGHT)))
        drone.go(1000, FAR, 0.0, lambda _: None)
        await asyncio.sleep(after)
        here = drone.body.position
        velocity = await _velocity(drone)
        turn = radians(degrees)
        there = _within(here[0] + metres * cos(turn), here[1] + metres * sin(turn))
        ends: list[float] = []
        began = drone.clock()
        drone.go(1001, there, 0.0, lambda _: ends.append(drone.clock()))
        while not ends and drone.clock() < began + LONGEST:
            await asyncio.sleep(LOOK)
        expected = EXACT.sent_on(velocity, here, there, SCOUT.speed) + EXACT.stops(SCOUT.speed)
        return ends[0] - began, expected


async def _velocity(drone: Flying) -> Point:
    before = drone.body.position
    await asyncio.sleep(LOOK)
    x, y, z = ((b - a) / LOOK for a, b in zip(before, drone.body.position, strict=True))
    return x, y, z


def _within(x: float, y: float) -> Point:
    width, depth = HALL.size
    return min(max(x, 0.0), width), min(max(y, 0.0), depth), HEIGHT


def main() -> int:
    """Print a row for each leg."""
    argparse.ArgumentParser(
        description="How long a Crazyflie takes to where it is sent while it flies."
    ).parse_args()
    print("| it has flown, s | metres | on: measured, model | aside | back |")
    print("| ---: | ---: | ---: | ---: | ---: |")
    off: list[float] = []
    for after in AFTER:
        for metres in METRES:
            cells: list[str] = []
            for degrees in SIDES.values():
                with TemporaryDirectory() as folder:
                    work = sent_on(after, metres, degrees, Path(folder))
                    measured, expected = in_virtual_time(work)
                off.append(abs(measured - expected))
                cells.append(f"{measured:.1f}, {expected:.1f}")
            print(f"| {after} | {metres} | {' | '.join(cells)} |", flush=True)
    print(f"in the mean {fmean(off):.2f} s from each other, at most {max(off):.2f} s")
    return 1 if fmean(off) > MOST else 0


if __name__ == "__main__":
    raise SystemExit(main())
