"""Flies the outdoor form of every example with simulated vehicles of both makes, beside what `simulate` says of it.

    python -m tests.flights_mavlink.examples
    python -m tests.flights_mavlink.examples aerial_mapping --make px4 --times 10 --at-once 2

In real time, through MAVSDK: with all vehicles of the form's fleet file, two rounds at most without a pause between,
and content with each photo. Then it prints for each form and make how many trips were completed, how long all took from when the vehicles
were ready, and the lowest battery at a landing, flown and simulated with many seeds. Wrong is a trip that was not
completed, and a promise that is off by more than 5 % of the time, or 5 points of a battery. Each flight has a folder
of its own, which is named.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from statistics import median
from tempfile import mkdtemp

from pluto_fleet.shared.domain.text import duration, number, percent
from tests.apart import apart
from tests.flights_crazyflie.campaign import seen_through
from tests.flights_crazyflie.judge import badly_ended
from tests.flights_mavlink.flight import VehicleFlight
from tests.kit.apps import EXAMPLES
from tests.kit.campaign import Campaign
from tests.prediction.flights import came_of, prepared, promise
from tests.prediction.plans import Plan, outdoors
from tests.prediction.record import Flown, Promise
from tests.prediction.table import ERROR, POINTS, error, points

FORMS = tuple(sorted(file.parent.name for file in EXAMPLES.glob("*/outdoors.toml")))
MAKES = ("px4", "ardupilot")
SEEDS = 10
_PATIENCE = 1800.0
_HEADER = (
    "| form, make | trips completed | flown: median | least–most | simulated | off"
    " | lowest battery flown | simulated |"
)


def fly(plan: Plan, source: Path, folder: Path) -> tuple[Flown | None, list[str]]:
    """Fly a form to its end; return what came of it, and what was wrong."""
    flight = prepared(plan, source, folder, VehicleFlight)
    came: list[Flown] = []

    def judged(code: int) -> Iterator[str]:
        came.append(came_of(plan, flight, code))
        yield from badly_ended(flight, code)
        yield from (f"{id} is in the air" for id in flight.airborne())
        yield from (f"{id} fell" for id, one in flight.state.items() if one["fell"])
        failed = [event["reason"] for event in flight.events if event["event"] == "trip.failed"]
        yield from (f"a trip has failed: {reason}" for reason in failed)

    wrong = seen_through(flight, judged, limit=_PATIENCE)
    return (came[0] if came else None), wrong


def row(promised: Promise, flights: Sequence[Flown]) -> str:
    """Return the row of a form and a make."""
    spans = [one.makespan for one in flights]
    launched = sum(one.flights for one in flights)
    done = launched - sum(one.failed for one in flights)
    cells = (
        promised.plan,
        f"{done} of {launched}",
        duration(median(spans)),
        f"{duration(min(spans))}–{duration(max(spans))}",
        duration(promised.median),
        f"{error(promised, flights):+.1f} %",
        percent(median(one.battery for one in flights)),
        percent(promised.battery),
    )
    return f"| {' | '.join(cells)} |"


def broken(promised: Promise, flights: Sequence[Flown]) -> Iterator[str]:
    """Yield the bounds that a promise has broken."""
    off = error(promised, flights)
    if abs(off) > ERROR:
        yield f"simulated is {off:+.1f} % off, more than {number(ERROR)} %"
    low = points(promised, flights)
    if abs(low) > POINTS:
        yield f"the lowest battery is {low:+.1f} points off, more than {number(POINTS)}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the forms that are named, or all; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_mavlink.examples", __doc__)
    campaign.unit = "flight"
    campaign.option("names", nargs="*", metavar="EXAMPLE", help="default: all with such a form")
    campaign.option("--make", choices=MAKES, help="default: both")
    campaign.option("--times", type=int, default=1, help="how often each is flown (default: 1)")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    names = options.names or FORMS
    if unknown := [name for name in names if name not in FORMS]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(FORMS)}")
    makes = MAKES if options.make is None else (options.make,)
    folder = Path(mkdtemp(prefix="outdoors-"))
    print(f"flights in {folder}", flush=True)
    plans = {plan.name: plan for plan in (outdoors(*both) for both in product(names, makes))}
    sources = {name: plan.compiled(folder / name / "app") for name, plan in plans.items()}

    def promised(name: str) -> Promise:
        place = folder / name / "simulated"
        return promise(plans[name], sources[name], place, SEEDS, VehicleFlight)

    def flown(case: tuple[str, int]) -> tuple[Flown | None, list[str]]:
        name, number = case
        return fly(plans[name], sources[name], folder / name / str(number))

    done: dict[str, list[Flown]] = {}
    cases = [(name, number) for number in range(1, options.times + 1) for name in plans]
    for (name, nth), (came, wrong) in campaign.each(flown, cases, threads=True):
        if came is not None:
            took = f"{duration(came.makespan)}, {percent(came.battery)} left"
            print(f"{name}, {nth}: {took}, load {came.load:.1f}", flush=True)
            done.setdefault(name, []).append(came)
        if wrong:
            campaign.found(f"{name}, {nth}", *wrong)
    promises = {name: promised(name) for name in done}
    for name, flights in done.items():
        if off := list(broken(promises[name], flights)):
            campaign.found(name, *off)
    rows = (row(promises[name], flights) for name, flights in done.items())
    return campaign.over("", _HEADER, f"|{' --- |' * _HEADER.count(' | ')} --- |", *rows, "")


if __name__ == "__main__":
    with apart():
        sys.exit(main())
