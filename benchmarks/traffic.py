"""How near do drones come to each other, and what does it cost to keep them apart?

    python benchmarks/traffic.py

Pairs of trips that cross fly in virtual time, two drones at once or ten, with random homes and targets,
and every tenth of a second it is seen where all are. The same trips fly once more with `apart = 0`:
throughput is trips an hour of simulated time. `--descents N` lets ten drones come down N times, all at
once, and says how much later than the slowest alone the last of them is down; with `--real SPEED`, as real drones
fly, from rest to rest and with that peak speed. `--narrow N` lets 4, 8, 14 and 20 drones fly N times through corridors,
doors and gaps, and says how long their flights wait for each other. Ends with 1 if any two were
nearer than `apart`, the last was more than two seconds late to land where it is, or a flight waited longer than it may.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import dist, inf
from pathlib import Path
from random import Random
from statistics import fmean

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from measuring.narrow_places import PLACES, longest_wait
from measuring.narrow_places import flown as flown_in
from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.traffic.real_skies import PRECISE
from tests.library.gateway.traffic.real_skies import late as late_for_real
from tests.library.gateway.traffic.skies import Sky

APART, HEIGHT = 0.5, 1.2


@dataclass(slots=True, kw_only=True)
class Figures:
    """What was seen."""

    nearest: float = inf
    trips: int = 0
    simulated: float = 0.0
    """Seconds."""
    cpu: float = 0.0

    def note(self, sky: Sky, trips: int) -> None:
        """Count one run in."""
        self.nearest = min(self.nearest, sky.nearest)
        self.trips += trips
        self.simulated += sky.kernel.now

    def __str__(self) -> str:
        an_hour = 3600 * self.trips / self.simulated
        near = (
            "no drones near each other" if self.nearest == inf else f"nearest {self.nearest:.3f} m"
        )
        return f"{near}, {an_hour:.0f} trips an hour, {1e6 * self.cpu / self.trips:.0f} µs of CPU a trip"


def places(chance: Random, count: int, side: float, z: float, apart: float = APART) -> list[Point]:
    """Return places that are nowhere nearer than that."""
    found: list[Point] = []
    while len(found) < count:
        place = chance.uniform(0, side), chance.uniform(0, side), z
        if all(dist(place, other) >= apart for other in found):
            found.append(place)
    return found


def _crosses(a: Point, b: Point, c: Point, d: Point) -> bool:
    def side(p: Point, q: Point, r: Point) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def crossings(seed: int, drones: int, side: float) -> tuple[list[Point], list[Point]]:
    """Return homes and targets; of each two drones, the ways cross."""
    chance = Random(seed)
    while True:
        homes, targets = places(chance, drones, side, 0.0), places(chance, drones, side, HEIGHT)
        pairs = range(0, drones, 2)
        if all(_crosses(homes[i], targets[i], homes[i + 1], targets[i + 1]) for i in pairs):
            return homes, targets
        if drones > 2:  # that would take for ever: each target goes to whom it lets cross
            for i in pairs:
                a, b = homes[i], homes[i + 1]
                middle = [(p + q) / 2 for p, q in zip(a[:2], b[:2], strict=True)]
                turn = chance.uniform(0.5, 2)
                targets[i] = _beyond(a, middle, b, turn, side)
                targets[i + 1] = _beyond(b, middle, a, turn, side)
            if all(dist(p, q) >= APART for p, q in _pairs(targets)):
                return homes, targets


def _beyond(home: Point, middle: Sequence[float], other: Point, far: float, side: float) -> Point:
    """Return a target beyond the place where both ways meet, beside the line between the homes."""
    dx, dy = other[0] - home[0], other[1] - home[1]
    x, y = middle[0] - far * dy / 2, middle[1] + far * dx / 2
    to_x, to_y = home[0] + 1.6 * (x - home[0]), home[1] + 1.6 * (y - home[1])
    return min(max(to_x, 0.0), side), min(max(to_y, 0.0), side), HEIGHT


def _pairs(points: Sequence[Point]) -> Iterator[tuple[Point, Point]]:
    return ((p, q) for i, p in enumerate(points) for q in points[:i])


def flown(homes: Sequence[Point], targets: Sequence[Point], side: float, apart: float) -> Sky:
    """Let every drone fly to its target and home, all at once."""
    sky = Sky([home[:2] for home in homes], airspace=Airspace(size=(side, side)), apart=apart)

    async def trip(drone: str, target: Point) -> None:
        await sky.fly(drone, target)
        await sky.goes_home(drone)

    trips = [
        sky.kernel.spawn(trip(drone.id, target), FLEET + 100 + drone.index, drone.id)
        for drone, target in zip(sky.drones, targets, strict=True)
    ]
    for one in trips:
        if not sky.until(one, 3600):
            raise SystemExit(f"{one.name} is under way for more than an hour")
    sky.kernel.close()
    return sky


def measured(runs: int, drones: int, side: float) -> Figures:
    """Fly, and say what was seen, with and without a distance."""
    seen = {APART: Figures(), 0.0: Figures()}
    for seed in range(runs):
        homes, targets = crossings(seed, drones, side)
        for apart, figures in seen.items():
            before = time.process_time()
            figures.note(flown(homes, targets, side, apart), drones)
            figures.cpu += time.process_time() - before
    print(f"{runs} times {drones} drones on {side:g} m × {side:g} m:")
    print(f"  apart = {APART:g} m: {seen[APART]}")
    print(f"  apart = 0:     {seen[0.0]}")
    kept = seen[0.0].simulated / seen[APART].simulated
    print(f"  that is {100 * kept:.1f} % of the throughput without a distance")
    return seen[APART]


def lateness(
    seed: int, side: float, how: Down, drones: int = 10, speed: float | None = None
) -> tuple[float, float]:
    """Return how much later than the slowest alone all are down, and how near any two came.

    With a speed they fly as real drones do.
    """
    chance = Random(seed)
    apart = APART if speed is None else APART + PRECISE.slack
    homes = places(chance, drones, side, 0.0, apart)
    hovering = places(chance, drones, side, HEIGHT, apart)
    if speed is not None:
        late, real = late_for_real(homes, hovering, Airspace(size=(side, side)), speed, how)
        return late, real.nearest

    def down(homes: Sequence[Point], hovering: Sequence[Point]) -> Sky:
        sky = Sky([home[:2] for home in homes], airspace=Airspace(size=(side, side)))
        sky.puts(*hovering)
        if not sky.until(sky.gateway.bring_down(how), 600):
            raise SystemExit(f"case {seed}: not all are down after ten minutes")
        sky.kernel.close()
        return sky

    alone = max(
        down([home], [place]).kernel.now for home, place in zip(homes, hovering, strict=True)
    )
    sky = down(homes, hovering)
    return sky.kernel.now - alone, sky.nearest


def waits(runs: int, drones: int, is_real: bool) -> bool:
    """Fly in narrow places, and print how long flights wait; return whether none waits longer than it may."""
    waited, spare, nearest = list[float](), inf, inf
    for kind in PLACES:
        for seed in range(runs):
            flights, sky = flown_in(kind, seed, drones, is_real)
            waited += (one.waited for one in flights)
            spare = min(spare, *(longest_wait(one, flights) - one.waited for one in flights))
            nearest = min(nearest, sky.nearest)
    waited.sort()
    print(
        f"{drones:2} {'as real ones' if is_real else 'simulated'}: {len(waited)} flights wait ",
        end="",
    )
    print(f"{fmean(waited):.0f} s, one of 20 {waited[-len(waited) // 20]:.0f} s, ", end="")
    print(f"at most {waited[-1]:.0f} s; {spare:.0f} s less than they may; nearest {nearest:.3f} m")
    return spare >= 0 and nearest >= APART - 1e-6


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--pairs", type=int, default=10_000, help="how many pairs of trips")
    parser.add_argument("--tens", type=int, default=1000, help="how many times ten drones")
    parser.add_argument("--side", type=float, default=10.0, help="of the map, in metres")
    parser.add_argument("--descents", type=int, default=0, help="how many times ten come down")
    parser.add_argument("--narrow", type=int, default=0, help="how many times in narrow places")
    parser.add_argument(
        "--real", type=float, metavar="SPEED", help="real drones, this fast at most"
    )
    options = parser.parse_args()
    good = True
    for runs, drones in ((options.pairs, 2), (options.tens, 10)):
        if runs:
            good &= measured(runs, drones, options.side).nearest >= APART - 1e-6
    for how in (Down.HOME, Down.LAND):
        if options.descents:
            found = [
                lateness(seed, options.side, how, speed=options.real)
                for seed in range(options.descents)
            ]
            late, near = max(one for one, _ in found), min(one for _, one in found)
            mean = fmean(one for one, _ in found)
            print(f"{options.descents} times ten drones come down ({how.value}): ", end="")
            print(
                f"{mean:.1f} s in the mean, at most {late:.1f} s later than the slowest alone, nearest {near:.3f} m"
            )
            good &= (how is Down.HOME or late <= 2) and near >= APART - 1e-6
    for drones in (4, 8, 14, 20) if options.narrow else ():
        for is_real in (False, True):
            good &= waits(options.narrow, drones, is_real)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
