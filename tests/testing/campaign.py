"""Strikes every example everywhere, and by chance, and prints what struck and what was found.

    python -m tests.testing.campaign --seeds 20

For each seed: a crash, a Stop and both at every row of the journal, deaths in the midst of every
action, and cases in which anything may strike. Where something is that may not be, the smallest case
is printed, and the exit code is 1; so it is where one of the faults has never struck.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from time import perf_counter, process_time

from plutoc_runtime.app import App
from plutoc_runtime.cli.report import table
from plutoc_runtime.files.fleet import FleetFile
from plutoc_runtime.testing.case import Case
from plutoc_runtime.testing.explore import (
    FAULTS,
    Finding,
    Tally,
    drawn_case,
    everywhere,
    explored,
    small_case,
)
from plutoc_runtime.testing.options import Options
from plutoc_runtime.testing.report import smallest_case
from plutoc_runtime.testing.rig import tried
from plutoc_runtime.testing.shrink import shrunk
from tests.flying import NAMES
from tests.testing.examples import example, fleet_of

HEADER = ("example", "runs", "rows", "lives", "completed", "failed", "cancelled", "found", "s")
CHANCES = 20
"""Cases by chance for each seed."""
ENOUGH = 5
"""After so many findings in an example nobody looks for more."""


def cases(app: App, fleet: FleetFile, seeds: range) -> Iterator[Case]:
    """Yield everything that is tried of one example."""
    for seed in seeds:
        for number in range(CHANCES):
            yield drawn_case(app, fleet, seed * CHANCES + number)
        yield from everywhere(app, small_case(app, fleet, seed))


def struck(name: str, seeds: range) -> tuple[Tally, float, list[str]]:
    """Try one example; return what came of it, the seconds it took, and what to print of it."""
    began = process_time()
    app = example(name)
    fleet, tally = fleet_of(name, app), Tally()
    explored(app, cases(app, fleet, seeds), tally, lambda tally: len(tally.findings) >= ENOUGH)
    said: list[str] = []
    if tally.findings:
        small = shrunk(tally.findings[0].case, lambda case: bool(tried(app, case).violations))
        finding = Finding(case=small, sentences=tried(app, small).violations)
        folder = Path("examples") / name
        options = Options(file=folder / "app.pluto", fleet=folder / "fleet.toml")
        said = [f"--- {name}", *smallest_case(app, options, finding)]
        tally.findings = [Finding(case=small, sentences=f.sentences) for f in tally.findings]
    return tally, process_time() - began, said


def report(tallies: Sequence[tuple[str, Tally, float]]) -> Iterator[str]:
    """Yield the lines of both tables."""
    yield from table(HEADER, [_row(*each) for each in tallies], right=range(1, len(HEADER)))
    yield ""
    fired = _sum(tallies)
    yield from table(
        ("what struck", "how often"), [(what, str(fired[what])) for what in FAULTS], right=(1,)
    )


def _row(name: str, tally: Tally, seconds: float) -> tuple[str, ...]:
    ends = [tally.missions[status] for status in ("COMPLETED", "FAILED", "CANCELLED")]
    numbers = (tally.runs, tally.rows, tally.lives, *ends, len(tally.findings), round(seconds))
    return (name, *map(str, numbers))


def _sum(tallies: Sequence[tuple[str, Tally, float]]) -> Counter[str]:
    return sum((tally.fired for _, tally, _ in tallies), Counter[str]())


def main(arguments: Sequence[str] | None = None) -> int:
    """Try what the command line asks for."""
    parser = ArgumentParser(
        prog="python -m tests.testing.campaign", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="default: all")
    parser.add_argument("--seeds", type=int, default=20, metavar="N", help="default: 20")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.examples) - set(NAMES))
    if unknown:
        parser.error(f"no such example: {', '.join(unknown)} (there are {', '.join(NAMES)})")
    names, began = options.examples or NAMES, perf_counter()
    try_one = partial(struck, seeds=range(options.first, options.first + options.seeds))
    if options.jobs > 1:
        with ProcessPoolExecutor(options.jobs) as pool:
            results = list(pool.map(try_one, names))
    else:
        results = [try_one(name) for name in names]
    tallies = [(name, tally, s) for name, (tally, s, _) in zip(names, results, strict=True)]
    for line in report(tallies):
        print(line)
    for line in (line for _, _, said in results for line in said):
        print(line)
    found = sum(len(tally.findings) for _, tally, _ in tallies)
    runs = sum(tally.runs for _, tally, _ in tallies)
    never = [what for what in FAULTS if not _sum(tallies)[what]]
    print(f"{runs} runs in {perf_counter() - began:.0f} s, {found} violations")
    if never:
        print(f"never struck: {', '.join(never)}")
    return 1 if found or never else 0


if __name__ == "__main__":
    sys.exit(main())
