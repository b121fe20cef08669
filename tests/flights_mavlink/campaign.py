"""Flies every scenario of faults with MAVSDK and simulated autopilots of both makes, and prints what came of it.

    python -m tests.flights_mavlink.campaign
    python -m tests.flights_mavlink.campaign "a motor dies, px4" --times 3
    python -m tests.flights_mavlink.campaign --seeds 20 --at-once 4

With `--seeds` faults, their moments and their vehicles are drawn instead, and must keep the rules of all flights.
Each flight has a folder of its own, which is named where something was wrong.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import mkdtemp

from tests.apart import apart
from tests.flights_crazyflie.campaign import seen_through
from tests.flights_crazyflie.flight import Flight
from tests.flights_mavlink.drawn import Drawn, drawn
from tests.flights_mavlink.scenarios import BROKEN, SCENARIOS, Scenario
from tests.flights_mavlink.vehicles import LIMIT, package, prepared
from tests.kit.campaign import Campaign


def fly(scenario: Scenario, broken: str, source: Path, folder: Path) -> tuple[Flight, list[str]]:
    """Fly a scenario to its end; return the flight, and what was wrong with it."""
    flight = prepared(source, folder, scenario.parameters)
    scenario.begin(flight, broken)

    def judged(code: int) -> Iterator[str]:
        return scenario.wrong(flight, broken, code)

    def during(_: Flight) -> None:
        scenario.go_on(flight, broken)

    return flight, seen_through(flight, judged, during, LIMIT)


def fly_drawn(case: Drawn, source: Path, folder: Path) -> tuple[Flight, list[str]]:
    """Fly with faults that were drawn to the end; return the flight, and what was wrong with it."""
    flight = prepared(source, folder, case.parameters)
    case.begin(flight)

    def judged(code: int) -> Iterator[str]:
        return case.wrong(flight, code)

    def during(_: Flight) -> None:
        case.go_on(flight)

    return flight, seen_through(flight, judged, during, LIMIT)


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the scenarios that are named, or all, or what is drawn; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_mavlink.campaign", __doc__)
    campaign.unit = "flight"
    by_name = {
        f"{scenario.name}, {make}": (scenario, broken)
        for scenario in SCENARIOS
        for make, broken in BROKEN.items()
    }
    campaign.option("names", nargs="*", metavar="SCENARIO", help="default: all")
    campaign.option("--times", type=int, default=1, metavar="N", help="how often (default: 1)")
    campaign.option("--seeds", type=int, metavar="N", help="draw the faults of N flights")
    campaign.option("--first", type=int, default=0, metavar="SEED", help="of those (default: 0)")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    names = options.names or list(by_name)
    if unknown := [name for name in names if name not in by_name]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(by_name)}")
    folder = Path(mkdtemp(prefix="vehicles-"))
    source = package(folder / "package")
    print(f"flights in {folder}", flush=True)

    def flown(case: tuple[str, int]) -> tuple[Flight, list[str]]:
        name, number = case
        where = folder / f"{re.sub('[^a-z0-9]+', '-', name)}-{number}"
        if options.seeds is not None:
            return fly_drawn(drawn(number), source, where)
        return fly(*by_name[name], source, where)

    if options.seeds is None:
        cases = [(name, number) for number in range(options.times) for name in names]
    else:
        seeds = range(options.first, options.first + options.seeds)
        cases = [(f"seed {seed}: {drawn(seed)}", seed) for seed in seeds]
    for (name, _), (flight, wrong) in campaign.each(flown, cases, threads=True):
        print(f"{name:50} {'; '.join(flight.notes)}", flush=True)
        if wrong:
            campaign.found(name, *wrong)
    return campaign.over()


if __name__ == "__main__":
    with apart():
        sys.exit(main())
