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
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from pluto_fleet.app import described
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.hooks.context import Verdict
from pluto_fleet.trials.case import Case, Weather
from pluto_fleet.trials.explore import Tally, everywhere, explored, random_case, small_case
from plutoc.compile import analyse, planned
from plutoc.source import Source
from tests.equivalence.flows import packaged
from tests.kit.campaign import Campaign
from tests.kit.graphs.usual import calm
from tests.trials.campaign import smallest

if TYPE_CHECKING:
    from pluto_fleet.app import App

CASES = 10
"""Of either kind that is drawn, for each app."""


REPEATS = ("", " safe", " once", " ask")


def random_source(rng: Random) -> str:
    """Return an app with two categories, each of which can do what the other cannot."""
    own = [f"do{number}" for number in range(rng.choice((1, 1, 2)))]
    seen = rng.choice(("measure", "take_photo", "measure, take_photo"))
    carries = ", pick_item, release_item" if rng.random() < 0.3 else ""
    return calm(
        rng,
        *(f"action {name}{rng.choice(REPEATS)}" for name in own),
        f"category watcher{_habits(rng)} can {seen}",
        f"category worker{_habits(rng)} can {', '.join(own)}{carries}",
    )


def _habits(rng: Random) -> str:
    given = {
        "speed": rng.choice(("0.5 m/s", "1 m/s")),
        "flight_time": rng.choice(("4 min", "7 min", "12 min")),
        "payload": "15 g",
        "reserve": rng.choice(("20 %", "40 %")),
    }
    chosen = [f"{name}: {value}" for name, value in given.items() if rng.random() < 0.4]
    return f"({', '.join(chosen)})" if chosen else ""


def random_app(rng: Random) -> App:
    """Return such an app, on the runtime in place; its hooks take their time and do no wrong."""
    package = packaged(planned(analyse(Source("app.pluto", random_source(rng)))[0]))
    hooks = SimpleNamespace(do0=_act, do1=_act, judge_it=_judge)
    return described(package.app(hooks, patient=True))


async def _act(_: object, __: object, context: Any) -> object:
    """Do something for a while."""
    await context.sleep(2.0)
    return 1.0


def _judge(*_: object) -> Verdict:
    """Be content."""
    return Verdict()


def random_fleet(rng: Random) -> FleetFile:
    """Return a fleet of both kinds; some stand near to each other, some stay where they land."""
    size = rng.choice(((4.0, 4.0), (10.0, 8.0), (30.0, 20.0)))
    names = ["watcher", "worker", *(rng.choice(("watcher", "worker")) for _ in range(3))]
    names = names[: rng.choice((2, 3, 4, 5))]
    step = rng.choice((0.6, 0.7))
    drones = tuple(
        DroneEntry(id=f"s{place + 1}", category=name, home=(0.5 + step * place, 0.5, 0.0))
        for place, name in enumerate(names)
    )
    return FleetFile(
        airspace=Airspace(size=size),
        drones=drones,
        after_trip=rng.choice((AfterTrip.HOME, *AfterTrip)),
        apart=rng.choice((0.5, 0.5, 0.3)),
        max_airborne=rng.choice((None, None, 1, 2)),
    )


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
        said = [random_source(Random(f"{number}/app"))]
        said += smallest(app, Path("app.pluto"), first, attrgetter("wrong"))
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
