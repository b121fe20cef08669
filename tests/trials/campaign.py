"""Strikes every example everywhere, and by chance, and prints what struck and what was found.

    python -m tests.trials.campaign --seeds 20

For each seed: small missions, with a crash, a Stop and both at every row of the journal and deaths in
the midst of every action, and cases in which anything may strike; with `--own` the example's own
missions instead. Where something is that may not be, the smallest case is printed, and the exit code
is 1; so it is where one of the faults has never struck.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter
from pathlib import Path
from random import Random
from time import perf_counter, process_time
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.report.report import table
from pluto_fleet.shared.domain.model import AfterTrip, Mission
from pluto_fleet.trials.case import WORDS, Case
from pluto_fleet.trials.explore import (
    Finding,
    Tally,
    everywhere,
    explored,
    random_case,
    small_case,
)
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.options import Options
from pluto_fleet.trials.report import smallest_case
from pluto_fleet.trials.shrink import first_the_same, shows_the_same, shrunk
from tests.kit.apps import NAMES
from tests.trials.examples import example, fleet_of, missions_of

HEADER = ("example", "runs", "rows", "lives", "completed", "failed", "cancelled", "found", "s")
CHANCES = 20
"""Cases by chance for each seed."""
ENOUGH = 5
"""After so many findings in an example no more are looked for."""

_VIOLATIONS = attrgetter("violations")
"""What is looked for: an evaluator may well ask too much of half a fleet."""


def cases(
    app: App, fleet: FleetFile, seeds: range, own: Sequence[Mission[Any]] = ()
) -> Iterator[Case]:
    """Yield everything that is tried of one example; its own missions only, if they are given."""
    for seed in seeds:
        if own:
            yield from everywhere(app, small_case(app, fleet, seed, own))
            continue
        for number in range(CHANCES):
            chance = seed * CHANCES + number
            yield random_case(app, varied(fleet, Random(chance)), chance)
        yield from everywhere(app, small_case(app, fleet, seed))


def varied(fleet: FleetFile, rng: Random) -> FleetFile:
    """Return a fleet with as many drones as may be, and other habits."""
    drones = fleet.drones[: rng.randrange(1, len(fleet.drones) + 1)]
    if rng.random() < 0.5:
        drones = fleet.drones
    after_trip = rng.choice((AfterTrip.HOME, AfterTrip.STAY, AfterTrip.NEXT))
    airborne = rng.choice((None, None, 1, 2))
    return replace(fleet, drones=drones, after_trip=after_trip, max_airborne=airborne)


@dataclass(frozen=True, slots=True, kw_only=True)
class Struck:
    """What came of one example."""

    name: str
    tally: Tally
    found: int
    """In how many cases something was that may not be."""
    said: tuple[str, ...]
    """The smallest of them, in words."""
    seconds: float

    @property
    def row(self) -> tuple[str, ...]:
        """A line of the table."""
        tally = self.tally
        ends = [tally.missions[status] for status in ("COMPLETED", "FAILED", "CANCELLED")]
        numbers = (tally.runs, tally.rows, tally.lives, *ends, self.found, round(self.seconds))
        return (self.name, *map(str, numbers))


def struck(name: str, seeds: range, own: bool = False) -> Struck:
    """Try one example."""
    began = process_time()
    app = example(name)
    fleet, tally = fleet_of(name, app), Tally()
    missions = missions_of(name, app, fleet) if own else ()
    explored(
        app,
        cases(app, fleet, seeds, missions),
        tally,
        lambda tally: len(tally.findings) >= ENOUGH,
        _VIOLATIONS,
    )
    findings, tally.findings = tally.findings, []  # they are of classes that no other process has
    said: list[str] = []
    if findings:
        first = findings[0]
        small = shrunk(first.case, shows_the_same(app, first, _VIOLATIONS))
        sentences = first_the_same(first, tried(app, small).violations)
        options = Options(file=Path("examples") / name / "app.pluto")
        smallest = smallest_case(app, options, Finding(case=small, sentences=sentences))
        said = [f"--- {name}", *first.sentences, "The smallest case:", *smallest]
    seconds = process_time() - began
    return Struck(name=name, tally=tally, found=len(findings), said=tuple(said), seconds=seconds)


def report(results: Sequence[Struck]) -> Iterator[str]:
    """Yield the lines of both tables, and what was found."""
    yield from table(HEADER, [result.row for result in results], right=range(1, len(HEADER)))
    yield ""
    fired = fired_in(results)
    yield from table(
        ("what struck", "how often"), [(what, str(fired[what])) for what in WORDS], right=(1,)
    )
    yield ""
    for result in results:
        yield from result.said


def fired_in(results: Sequence[Struck]) -> Counter[str]:
    """Return how often everything has struck."""
    return sum((result.tally.fired for result in results), Counter[str]())


def main(arguments: Sequence[str] | None = None) -> int:
    """Try what the command line asks for."""
    parser = ArgumentParser(
        prog="python -m tests.trials.campaign", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="default: all")
    parser.add_argument("--seeds", type=int, default=20, metavar="N", help="default: 20")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed")
    parser.add_argument("--own", action="store_true", help="its own missions, everywhere")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.examples) - set(NAMES))
    if unknown:
        parser.error(f"no such example: {', '.join(unknown)} (there are {', '.join(NAMES)})")
    names, began = options.examples or NAMES, perf_counter()
    seeds = range(options.first, options.first + options.seeds)
    try_one = partial(struck, seeds=seeds, own=options.own)
    if options.jobs > 1:
        with ProcessPoolExecutor(options.jobs) as pool:
            results = list(pool.map(try_one, names))
    else:
        results = [try_one(name) for name in names]
    for line in report(results):
        print(line)
    found, runs = sum(each.found for each in results), sum(each.tally.runs for each in results)
    never = [what for what in WORDS if not fired_in(results)[what]]
    print(f"{runs} runs in {perf_counter() - began:.0f} s, {found} violations")
    if never and not options.own:
        print(f"never struck: {', '.join(never)}")
    return 1 if found or (never and not options.own) else 0


if __name__ == "__main__":
    sys.exit(main())
