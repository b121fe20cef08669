"""Tries random apps that are new each time, as `plutoc test` does, in all weathers.

    python -m tests.trials.strangers --apps 200

Each has two categories of drones, which cannot stand in for each other, and actions of its own. For each
app: cases in which anything may strike, as many in which links are lost over a slow radio, and one
small case struck everywhere. What is found is printed with its app, as it was found and as small as it
gets; the exit code is 1 then.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from pluto_fleet.trials.case import Case, Weather
from pluto_fleet.trials.explore import Finding, Tally, everywhere, explored, random_case, small_case
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.options import Options
from pluto_fleet.trials.report import smallest_case
from pluto_fleet.trials.shrink import first_the_same, shows_the_same, shrunk
from tests.kit.campaign import Campaign
from tests.trials.random_apps import random_app, random_fleet, random_source

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.files.fleet import FleetFile

CASES = 10
"""Of either kind that is drawn, for each app."""


def cases(app: App, fleet: FleetFile, number: int, share: int, *, whole: bool) -> Iterator[Case]:
    """Yield everything that is tried of one app."""
    for seed in range(number * 1000, number * 1000 + share):
        case = random_case(app, fleet, seed)
        yield case
        yield replace(case, weather=bad_radio(Random(f"{seed}/radio")))
        yield replace(case, weather=bad_radio(Random(f"{seed}/radio")), strikes=())
    if whole:
        yield from everywhere(app, small_case(app, fleet, number))


def bad_radio(rng: Random) -> Weather:
    """Return weather in which links are lost, and every message to a drone takes its time."""
    return Weather(
        link=rng.choice((0.1, 0.3, 0.6)),
        radio=rng.choice((0.1, 0.5)),
        late=rng.choice((0.0, 0.3)),
        slow=rng.choice((0.0, 0.4)),
    )


def strange(number: int, *, share: int = CASES, whole: bool = True) -> tuple[int, list[str]]:
    """Try one app; return how many runs that were, and what was found, in words."""
    app = random_app(Random(f"{number}/app"))
    fleet, tally = random_fleet(Random(f"{number}/fleet")), Tally()
    todo = cases(app, fleet, number, share, whole=whole)
    explored(app, todo, tally, lambda tally: bool(tally.findings))
    said: list[str] = []
    for first in tally.findings:
        small = shrunk(first.case, shows_the_same(app, first, attrgetter("wrong")))
        finding = Finding(case=small, sentences=first_the_same(first, tried(app, small).wrong))
        said = [random_source(Random(f"{number}/app")), *first.sentences]
        said += smallest_case(app, Options(file=Path("app.pluto")), finding)
    return tally.runs, said


def main(arguments: Sequence[str] | None = None) -> int:
    """Try what the command line asks for."""
    campaign = Campaign("tests.trials.strangers", __doc__)
    campaign.draws("apps", 200)
    campaign.option(
        "--cases", dest="share", type=int, default=CASES, help="of each kind, for each app"
    )
    campaign.option("--drawn", action="store_true", help="strike none everywhere")
    options = campaign.parse(arguments)
    runs, one = 0, partial(strange, share=options.share, whole=not options.drawn)
    for number, (tried_so_often, said) in campaign.each(one, campaign.numbers):
        runs += tried_so_often
        if said:
            campaign.found(f"app {number}", *said)
    return campaign.over(f"{runs} runs")


if __name__ == "__main__":
    sys.exit(main())
