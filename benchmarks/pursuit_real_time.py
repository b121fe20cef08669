"""Does pursuit take as long in real time as `simulate` says?

`python benchmarks/pursuit_real_time.py` flies `examples/pursue` with three drones and two people by `pursue fly --sim`, each patrol once, ten
flights, so many at once as `--jobs` says, and simulates the same seeds. Printed is for each seed how many seconds passed in both from the
first sight of each person to the picture, then the medians and how far they are from each other. `--crtp-sim` flies simulated Crazyflies instead,
and prints how near two of them came to each other in the air, of their places fifty times a second.
Ends with 1 if the medians differ by more than 15 %, or two drones came nearer than the fleet keeps them apart.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from math import dist, inf
from pathlib import Path
from statistics import median

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from measuring.options import at_least_one
from pluto_fleet.crtp.flight_log import TRACE
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.journal.reader import Reader
from pluto_fleet.report.reactions import reactions_of
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.trials.case import fresh
from tests.kit import apps

DRONES = 3
PEOPLE = 2
OFF = 0.15
"""The share by which both may differ."""
ON_THE_GROUND = 0.1
"""Metres below which a drone is not in the air."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Files:
    """What is flown, in a folder."""

    package: Path
    missions: Path
    fleet: Path
    apart: float
    """Metres by which the fleet keeps its drones from each other."""


def written(folder: Path) -> Files:
    """Write the example's files with fewer drones, people and rounds."""
    example = apps.EXAMPLES / "pursue"
    missions = (example / "missions.toml").read_text().replace("repeat = 3", "repeat = 0")
    head, *tables = (
        (example / "fleet.toml").read_text().replace('image = "map.svg"', "").split("\n[[")
    )
    drones = [table for table in tables if table.startswith("drone]]")][:DRONES]
    people = [table for table in tables if table.startswith("world.mover]]")][:PEOPLE]
    (folder / "missions.toml").write_text(missions)
    (folder / "fleet.toml").write_text("\n[[".join([head, *drones, *people]))
    fleet = folder / "fleet.toml"
    return Files(
        package=apps.compiled("pursue"),
        missions=folder / "missions.toml",
        fleet=fleet,
        apart=load_fleet(fleet, apps.example("pursue").app).apart,
    )


def flown(files: Files, seed: int, speed: float, crtp: bool, folder: Path) -> list[float]:
    """Fly one seed in real time, and return how long pictures took."""
    journal = folder / f"{seed}.journal"
    words = [
        sys.executable,
        "-m",
        "pursue",
        "fly",
        str(files.missions),
        "--fleet",
        str(files.fleet),
    ]
    if crtp:  # chance is the firmware's
        words += ["--crtp-sim", str(DRONES)]
    else:
        words += ["--sim", "--speed", str(speed), "--seed", str(seed)]
    words += ["--journal", str(journal)]
    path = os.pathsep.join([str(files.package / "src"), *sys.path])
    ran = subprocess.run(
        words, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False
    )
    if not journal.exists():
        raise SystemExit(ran.stdout + ran.stderr)
    with closing(Reader(journal)) as reader:
        events = [event for _, event in reader.events()]
    return reactions_of(events).events["intruder"].seconds


def nearest(trace: Path) -> float:
    """Return how many metres the two drones were from each other that were nearest, in the air."""
    least = inf
    places: dict[str, Point] = {}
    for line in trace.read_text().splitlines():
        _, drone, *numbers = line.split(",")
        x, y, z = map(float, numbers)
        if z < ON_THE_GROUND:
            places.pop(drone, None)
            continue
        for other, there in places.items():
            if other != drone:
                least = min(least, dist((x, y, z), there))
        places[drone] = x, y, z
    return least


def simulated(files: Files, seed: int) -> list[float]:
    """Simulate one seed, and return how long pictures took."""
    app = apps.example("pursue").app
    fleet = load_fleet(files.fleet, app)
    missions = load_missions(files.missions, app, fleet.airspace)
    outcome = simulate(
        app,
        [fresh(mission) for mission in missions],
        fleet,
        seed=seed,
        faults=Faults(),
        until=None,
        on_event=None,
    )
    return reactions_of(outcome.events).events["intruder"].seconds


def main(words: Sequence[str] | None = None) -> int:
    """Print both for each seed, and how far they are from each other."""
    parser = argparse.ArgumentParser(description="Pursuit in real time beside simulations.")
    parser.add_argument("--flights", type=at_least_one, default=10)
    parser.add_argument("--speed", type=float, default=1.0, help="how fast time passes, with --sim")
    parser.add_argument("--jobs", type=at_least_one, default=2, help="flights at once")
    parser.add_argument("--crtp-sim", action="store_true", help="fly simulated Crazyflies")
    given = parser.parse_args(words)
    real: list[float] = []
    near = inf
    virtual: list[float] = []
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(given.jobs) as pool:
        folder = Path(name)
        files = written(folder)
        seeds = range(given.flights)
        flights = [
            pool.submit(flown, files, seed, given.speed, given.crtp_sim, folder) for seed in seeds
        ]
        for seed, flight in zip(seeds, flights, strict=True):
            found = flight.result()
            expected = simulated(files, seed)
            print(
                f"seed {seed}: {_shown(found)} in real time, {_shown(expected)} simulated",
                flush=True,
            )
            real += found
            trace = folder / f"{seed}.journal.gateway" / TRACE
            if trace.exists():
                near = min(near, nearest(trace))
            virtual += expected
    off = median(real) / median(virtual) - 1
    print(
        f"median {median(real):.1f} s in real time, {median(virtual):.1f} s simulated: {off:+.0%}"
    )
    if near < inf:
        print(f"nearest: {near:.2f} m, of {files.apart:.2f} m at least")
    return 1 if abs(off) > OFF or near < files.apart else 0


def _shown(seconds: Sequence[float]) -> str:
    return ", ".join(f"{one:.1f} s" for one in seconds) or "nobody seen"


if __name__ == "__main__":
    sys.exit(main())
