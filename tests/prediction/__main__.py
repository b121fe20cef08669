"""Compares what is promised of a plan with what simulated Crazyflies take, flown through cflib.

    python -m tests.prediction
    python -m tests.prediction "long legs" pm10
    python -m tests.prediction --repeat 10 drugs_distribution
    python -m tests.prediction --random 20 --seed 7
    python -m tests.prediction --show prediction.jsonl

Each plan is simulated with many seeds, and flown in real time. What is known is kept at once, in the
file that --keep names: the same command goes on where it was interrupted.
"""

from __future__ import annotations

import os
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from itertools import count
from pathlib import Path
from tempfile import mkdtemp

from pluto_fleet.shared.domain.text import duration
from tests.apart import apart
from tests.prediction.flights import fly, promise
from tests.prediction.plans import Plan, known
from tests.prediction.random_plans import random_plans
from tests.prediction.record import flown, keep, kept, promised
from tests.prediction.table import report

CORES = os.cpu_count() or 1
AT_ONCE = 4 * CORES
"""Flights side by side: one of five drones takes 6 % of a core, and three seconds of it to start."""
_BETWEEN = 4.0
"""Seconds between the first flights' starts."""
_LONGEST = 900.0
"""Seconds of the longest plan that is flown: among random ones there are longer ones."""
_INTERRUPTED = 128
"""The least exit code of what was interrupted."""


def main() -> int:
    """Fly the plans that are named; 1 if a flight did not end as it should."""
    options = _options()
    if options.show is not None:
        _print_report(options.show, None)
        return 0
    plans = _plans(options)
    folder = Path(mkdtemp(prefix="prediction-"))
    print(f"flights in {folder}; kept in {options.keep}", flush=True)
    sources = {name: plan.compiled(folder / _slug(name) / "app") for name, plan in plans.items()}
    _promise(options, plans, sources, folder)
    wrong = _fly(options, plans, sources, folder)
    print()
    _print_report(options.keep, plans)
    return 1 if wrong else 0


def _options() -> Namespace:
    parser = ArgumentParser(prog="python -m tests.prediction", description=__doc__)
    add = parser.add_argument
    what = "default: the examples and our own; with --random: none"
    add("names", nargs="*", metavar="PLAN", help=what)
    add("--random", type=int, default=0, metavar="N", help="also fly N random plans")
    add("--seed", type=int, default=0, metavar="S", help="what those are drawn from (default: 0)")
    add("--repeat", type=int, default=1, metavar="N", help="fly each plan N times (default: 1)")
    add("--seeds", type=int, default=50, metavar="N", help="simulate with N seeds (default: 50)")
    what = f"fly N plans side by side (default: {AT_ONCE})"
    add("--at-once", type=int, default=AT_ONCE, metavar="N", help=what)
    where = Path("prediction.jsonl")
    what = f"what is known already, and gets known (default: {where})"
    add("--keep", type=Path, default=where, metavar="FILE", help=what)
    add("--show", type=Path, metavar="FILE", help="fly nothing: print what such a file has")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in known()]
    if unknown:
        parser.error(f"there is no {unknown[0]}; there are {', '.join(known())}")
    return options


def _plans(options: Namespace) -> dict[str, Plan]:
    plans = known()
    names = options.names or ([] if options.random else list(plans))
    chosen = {name: plans[name] for name in names}
    for plan in random_plans(options.random, options.seed):
        chosen[plan.name] = plan
    if options.random:
        print(f"{options.random} random plans of seed {options.seed}")
    return chosen


def _promise(
    options: Namespace, plans: Mapping[str, Plan], sources: Mapping[str, Path], folder: Path
) -> None:
    """Simulate the plans that were not simulated before."""

    def one(name: str) -> None:
        where = folder / _slug(name) / "simulated"
        try:
            said = promise(plans[name], sources[name], where, options.seeds)
        except AssertionError as error:
            print(f"{name}: {error}", flush=True)
            return
        keep(options.keep, said)
        print(f"{name}: {duration(said.median)} promised", flush=True)

    left = [name for name in plans if name not in promised(kept(options.keep))]
    with ThreadPoolExecutor(CORES) as pool:
        list(pool.map(one, left))


def _fly(
    options: Namespace, plans: Mapping[str, Plan], sources: Mapping[str, Path], folder: Path
) -> int:
    """Fly what was not flown before, the longest first; return how many were not as meant."""
    known_lines = kept(options.keep)
    said, done = promised(known_lines), flown(known_lines)
    short = (name for name in said.keys() & plans.keys() if said[name].median <= _LONGEST)
    names = sorted(short, key=lambda name: -said[name].median)
    left = [
        name
        for name in names
        for _ in range(options.repeat - sum(not one.code for one in done.get(name, ())))
    ]

    def one(number: int, name: str) -> bool:
        if number < options.at_once:
            time.sleep(number * _BETWEEN)
        try:
            came = fly(plans[name], sources[name], folder / _slug(name) / f"flight{number}")
        except AssertionError as error:
            print(f"{name}: {error}", flush=True)
            return False
        if came.code < _INTERRUPTED:
            keep(options.keep, came)
        print(f"{name}: {duration(came.makespan)} flown, exit code {came.code}", flush=True)
        return came.code == 0

    with ThreadPoolExecutor(options.at_once) as pool:
        return [*pool.map(one, count(), left)].count(False)


def _print_report(file: Path, plans: Mapping[str, Plan] | None) -> None:
    """Print the report of a file, for these plans; None: for all."""
    lines = [line for line in kept(file) if plans is None or line.plan in plans]
    for line in report(promised(lines), flown(lines)):
        print(line)


def _slug(name: str) -> str:
    return "".join(letter if letter.isalnum() else "-" for letter in name)


if __name__ == "__main__":
    with apart():
        sys.exit(main())
