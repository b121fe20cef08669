"""Strikes every example everywhere, and by chance, and prints what struck and what was found.

    python -m tests.trials.campaign --seeds 20

For each seed: small missions, with a crash, a Stop and both at every row of the journal and deaths in
the midst of every action, and cases in which anything may strike; with `--own` the example's own
missions instead. Where something is that may not be, the smallest case is printed, and the exit code
is 1; so it is where one of the faults has never struck.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter
from pathlib import Path
from random import Random
from time import process_time
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.report.terminal import table
from pluto_fleet.shared.domain.model import AfterTrip, Mission
from pluto_fleet.trials.case import WORDS, Case
from pluto_fleet.trials.command import Options, smallest_case
from pluto_fleet.trials.explore import (
    Finding,
    Tally,
    everywhere,
    explored,
    first_the_same,
    random_case,
    shows_the_same,
    shrunk,
    small_case,
)
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.record import TrialResult
from tests.kit.apps import NAMES
from tests.kit.campaign import Campaign
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
    after_trip = rng.choice(list(AfterTrip))
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
    file = Path("examples") / name / "app.pluto"
    said = [line for first in findings[:1] for line in smallest(app, file, first, _VIOLATIONS)]
    seconds = process_time() - began
    return Struck(name=name, tally=tally, found=len(findings), said=tuple(said), seconds=seconds)


def smallest(
    app: App, file: Path, first: Finding, looks: Callable[[TrialResult], tuple[str, ...]]
) -> Iterator[str]:
    """Yield what was found, and the smallest case that shows the same."""
    small = shrunk(first.case, shows_the_same(app, first, looks))
    finding = Finding(case=small, sentences=first_the_same(first, looks(tried(app, small))))
    yield from (*first.sentences, "The smallest case:")
    yield from smallest_case(app, Options(file=file), finding)


def main(arguments: Sequence[str] | None = None) -> int:
    """Try what the command line asks for."""
    campaign = Campaign("tests.trials.campaign", __doc__)
    campaign.option(
        "examples", nargs="*", metavar="EXAMPLE", help=f"{', '.join(NAMES)}; default: all"
    )
    campaign.option("--seeds", type=int, default=20, metavar="N", help="default: 20")
    campaign.option("--first", type=int, default=0, metavar="SEED", help="the first seed")
    campaign.option("--own", action="store_true", help="its own missions, everywhere")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    unknown = sorted(set(options.examples) - set(NAMES))
    if unknown:
        campaign.parser.error(f"no such example: {', '.join(unknown)}")
    seeds = range(options.first, options.first + options.seeds)
    one = partial(struck, seeds=seeds, own=options.own)
    results: list[Struck] = []
    for name, came in campaign.each(one, options.examples or NAMES):
        results.append(came)
        if came.said:
            campaign.found(name, *came.said)
    fired = sum((result.tally.fired for result in results), Counter[str]())
    never = [what for what in WORDS if not fired[what]]
    return campaign.over(
        *table(HEADER, [result.row for result in results], right=range(1, len(HEADER))),
        "",
        *table(("what struck", "how often"), [(w, str(fired[w])) for w in WORDS], right=(1,)),
        f"{sum(each.tally.runs for each in results)} runs",
        fails=[f"never struck: {', '.join(never)}"] if never and not options.own else [],
    )


if __name__ == "__main__":
    sys.exit(main())
