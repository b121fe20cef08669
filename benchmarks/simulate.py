"""What does a trip cost `<app> simulate`, and how does that grow with the drones and with the trips?

`python benchmarks/simulate.py` compiles an app, and has it fly missions of five trips on a map of
40 m × 40 m, with and without `apart`, as its user would: each run is a process, and its CPU time
counts. Beside it fly a bare event loop and SimPy (with the extra `benchmarks`), both written by hand for
this alone, with the same physics: take off, fly there, act, fly home, land, charge; the first
trip that waits gets the nearest free drone. They know no graph, no failures and no other drone's way.

What a process takes to start is measured with one trip, printed, and taken off. The runs
of a row take turns, round after round; the least time of each counts. Then it prints the exponents
of the growth from each size to the next: it ends with 1 if the last is more than that of n log n. (100 trips
are flown with the first charge of each battery, and need less.)
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from itertools import pairwise
from math import log
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

from fleets.physics import PER_MISSION, SIDE, homes, targets
from measuring.options import at_least_one

FLEETS = (5, 20, 50)
TRIPS = (100, 1_000, 10_000)
USUAL = 20, 500
"""Drones and trips where the other is measured."""
LEAST, NOISE = 0.005, 0.1
"""Seconds below which no ratio is told, and what an exponent may be wrong by."""

SOURCE = """\
pluto 1
app measured "Trips that are simulated" {
  category scout(speed: 1 m/s) can take_photo
  create = MissionCreator
  allocate = DroneAllocator(policy: nearest)
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  retry = PriorityManager(max_attempts: 3)
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  retry -> end otherwise
  watch -> end otherwise
}
"""

Seconds = dict[str, float]


@dataclass(frozen=True, slots=True)
class Work:
    """What is flown."""

    trips: int
    drones: int


Command = Callable[[Work], Sequence[str]]


def contenders(package: Path) -> Mapping[str, Command]:
    """Return how each is started."""

    def pluto(apart: float, work: Work) -> Sequence[str]:
        plan, fleet = written(package, work, apart)
        return "-m", package.name, "simulate", str(plan), "--fleet", str(fleet), "--json"

    def by_hand(module: str, work: Work) -> Sequence[str]:
        return "-m", f"fleets.{module}", str(work.trips), str(work.drones)

    found: dict[str, Command] = {
        "apart = 0": partial(pluto, 0.0),
        "apart = 0.5": partial(pluto, 0.5),
        "bare loop": partial(by_hand, "bare"),
    }
    if find_spec("simpy") is not None:
        found["SimPy"] = partial(by_hand, "simpy_fleet")
    return found


def compiled(folder: Path) -> Path:
    """Compile the app, and return its package."""
    source = folder / "measured.pluto"
    source.write_text(SOURCE)
    command = [sys.executable, "-m", "plutoc", "compile", str(source)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder / source.stem


def written(package: Path, work: Work, apart: float) -> tuple[Path, Path]:
    """Write a plan and its fleet, unless they are there."""
    plan = package / f"{work.trips}.toml"
    fleet = package / f"{work.drones}_{apart:g}_fleet.toml"
    if not plan.exists():
        plan.write_text("".join(missions(work.trips)))
    if not fleet.exists():
        head = f"[map]\nsize = [{SIDE}, {SIDE}]\n[fleet]\napart = {apart}\n"
        docks = (
            f'[[drone]]\nid = "d{number}"\nhome = {list(home)}\n'
            for number, home in enumerate(homes(work.drones))
        )
        fleet.write_text(head + "".join(docks))
    return plan, fleet


def missions(trips: int) -> Iterator[str]:
    """Give the text of a missions file, in parts."""
    for number, target in enumerate(targets(trips)):
        if number % PER_MISSION == 0:
            yield f'[[mission]]\nname = "{number // PER_MISSION}"\n'
        yield f'[[mission.trip]]\naction = "take_photo"\ntarget = {list(target)}\n'


def taken(package: Path, command: Sequence[str], work: Work) -> float:
    """Run a process, see that it flew all trips, and return its seconds of CPU."""
    paths = [str(package / "src"), str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]
    before = getrusage(RUSAGE_CHILDREN)
    done = subprocess.run(
        [sys.executable, *command],
        check=True,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
    )
    after = getrusage(RUSAGE_CHILDREN)
    completed = json.loads(done.stdout)["trips"]["completed"]
    if completed != work.trips:
        raise SystemExit(f"{' '.join(command)} flew {completed} of {work.trips} trips")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def least(package: Path, commands: Mapping[str, Command], work: Work, rounds: int) -> Seconds:
    """Run all in turns; return the least seconds of each."""
    found: Seconds = {}
    for _ in range(rounds):
        for name, command in commands.items():
            seconds = taken(package, command(work), work)
            found[name] = min(seconds, found.get(name, seconds))
    return found


def growth(sizes: tuple[int, int], seconds: tuple[float, float]) -> float:
    """Return the exponent of the growth from one size to another."""
    return log(seconds[1] / seconds[0]) / log(sizes[1] / sizes[0])


def n_log_n(sizes: tuple[int, int]) -> float:
    """Return that exponent for n log n."""
    one, other = sizes
    return growth(sizes, (one * log(one), other * log(other)))


def table(
    title: str,
    rows: Mapping[Work, Seconds],
    start: Seconds,
    say: Callable[[str], None],
) -> dict[Work, Seconds]:
    """Print microseconds a trip, and how many times a bare loop's that is; return the seconds."""
    say(f"\n{title:>18}" + "".join(f"{name:>22}" for name in start))
    net = {
        work: {name: max(1e-6, one - start[name]) for name, one in row.items()}
        for work, row in rows.items()
    }
    for work, row in net.items():
        bare = row["bare loop"]
        cells = (
            f"{one / work.trips * 1e6:10,.0f} µs "
            + (f"({one / bare:5.1f} ×)" if bare > LEAST else "")
            for one in row.values()
        )
        say(f"{work.trips:8,} {work.drones:9}" + "".join(f"{cell:>22}" for cell in cells))
    return net


def measure(
    given: argparse.Namespace, say: Callable[[str], None]
) -> tuple[dict[str, object], bool]:
    """Measure everything, and say it line by line; return the figures, and whether all grow well."""
    usual = USUAL[0], min(USUAL[1], max(given.trips))
    with tempfile.TemporaryDirectory() as folder:
        package = compiled(Path(folder))
        commands = contenders(package)
        one = Work(1, usual[0])
        start = least(package, commands, one, given.rounds + 1)
        say(
            "to start, with one trip: "
            + ", ".join(f"{n} {s * 1e3:.0f} ms" for n, s in start.items())
        )
        works = [Work(usual[1], drones) for drones in given.fleets]
        works += [Work(trips, usual[0]) for trips in given.trips]
        rows = {work: least(package, commands, work, given.rounds) for work in works}
    net = table("trips    drones", rows, start, say)
    exponents: dict[str, float] = {}
    good = True
    by_drones = given.fleets, works[: len(given.fleets)]
    by_trips = given.trips, works[len(given.fleets) :]
    for what, (sizes, chosen) in {"drones": by_drones, "trips": by_trips}.items():
        for (one, first), (other, last) in pairwise(zip(sizes, chosen, strict=True)):
            limit = n_log_n((one, other))
            step = f"{one:,} to {other:,} {what}"
            say(f"\nexponent of the growth from {step} (n log n: {limit:.2f})")
            for name in start:
                found = growth((one, other), (net[first][name], net[last][name]))
                exponents[f"{step}, {name}"] = found
                say(f"{name:>18} {found:6.2f}")
                if other == sizes[-1] and name.startswith("apart"):
                    good &= found <= limit + NOISE
    figures = {f"{work.trips} trips, {work.drones} drones": row for work, row in net.items()}
    return {"start_s": start, "net_s": figures, "exponents": exponents}, good


def main() -> int:
    """Print tables, or JSON."""
    parser = argparse.ArgumentParser(description="What a trip costs in a simulation.")
    parser.add_argument("--rounds", type=at_least_one, default=3, help="each measures all once")
    parser.add_argument("--fleets", type=at_least_one, nargs="+", default=FLEETS, metavar="DRONES")
    parser.add_argument("--trips", type=at_least_one, nargs="+", default=TRIPS, metavar="TRIPS")
    parser.add_argument("--json", action="store_true", help="print one object instead of tables")
    given = parser.parse_args()
    say = (lambda line: None) if given.json else partial(print, flush=True)
    figures, good = measure(given, say)
    if given.json:
        print(json.dumps(figures, indent=2))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
