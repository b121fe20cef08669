"""Flies every example with many seeds while things go wrong, and prints a table.

    python -m tests.campaign --seeds 200

Every mission must end COMPLETED, or FAILED with a reason, and every invariant must hold. Where one
does not, the seed that shows it is named, and the exit code is 1.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from pluto_fleet.report.report import table
from pluto_fleet.trials.invariants import violations
from plutoc_runtime.alone.faults import shares
from tests.flying import MISHAPS, NAMES, Example, built

HEADER = ("example", "runs", "missions", "completed", "failed", "flights", "mishaps", "violations")
WORDS = 1
"""Columns of text, before those of numbers."""


@dataclass(slots=True, kw_only=True)
class Tally:
    """What came of one example's runs."""

    example: str
    runs: int = 0
    missions: Counter[str] = field(default_factory=Counter)
    """How many ended with which status."""
    flights: int = 0
    mishaps: int = 0
    violations: list[str] = field(default_factory=list)

    @property
    def row(self) -> tuple[str, ...]:
        """A line of the table."""
        numbers = (
            self.runs,
            self.missions.total(),
            self.missions["COMPLETED"],
            self.missions["FAILED"],
            self.flights,
            self.mishaps,
            len(self.violations),
        )
        return (self.example, *map(str, numbers))


def flown(example: Example, seeds: range, mishaps: Mapping[str, float]) -> Tally:
    """Fly an example with every seed, and count."""
    tally = Tally(example=example.name)
    for seed in seeds:
        run = example.fly(seed, mishaps)
        tally.runs += 1
        tally.missions.update(status for status, _ in run.ends)
        tally.flights += run.outcome.count("trip.launched")
        tally.mishaps += run.outcome.count("trip.failed")
        found = violations(run.trace, example.items)
        tally.violations += [f"{example.name}, seed {seed}: {sentence}" for sentence in found]
    return tally


def report(tallies: Sequence[Tally], seconds: float) -> Iterator[str]:
    """Yield the table's lines, and each violation."""
    rows = [tally.row for tally in tallies]
    yield from table(HEADER, rows, right=range(WORDS, len(HEADER)))
    yield ""
    broken = [sentence for tally in tallies for sentence in tally.violations]
    yield from broken
    runs = sum(tally.runs for tally in tallies)
    yield f"{runs} runs in {seconds:.1f} s, {len(broken)} violations"


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the campaign that the command line asks for."""
    parser = ArgumentParser(prog="python -m tests.campaign", description=__doc__.splitlines()[0])
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="default: all")
    parser.add_argument("--seeds", type=int, default=200, metavar="N", help="runs of each example")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed")
    parser.add_argument(
        "--fail", type=shares, default=MISHAPS, metavar="WHAT=SHARE,…", help="as for `simulate`"
    )
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.examples) - set(NAMES))
    if unknown:
        parser.error(f"no such example: {', '.join(unknown)} (there are {', '.join(NAMES)})")
    seeds = range(options.first, options.first + options.seeds)
    began = perf_counter()
    with TemporaryDirectory() as folder:
        tallies = [
            flown(built(name, Path(folder)), seeds, options.fail)
            for name in options.examples or NAMES
        ]
    for line in report(tallies, perf_counter() - began):
        print(line)
    return 1 if any(tally.violations for tally in tallies) else 0


if __name__ == "__main__":
    sys.exit(main())
