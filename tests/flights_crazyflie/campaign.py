"""Flies every scenario with the unmodified cflib, and prints what came of it.

    python -m tests.flights_crazyflie.campaign
    python -m tests.flights_crazyflie.campaign "tumbles" "link lost for 5 s"

Each flight has a folder of its own, which is named where something was wrong.
"""

from __future__ import annotations

import re
import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path
from tempfile import mkdtemp

from plutoc_runtime.crtp import process
from tests.crtp.starting import COMMAND
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import unmeant
from tests.flights_crazyflie.plans import (
    RETRY,
    SIZE,
    fleet,
    homes,
    missions,
    quick_package,
    tours,
    write,
)
from tests.flights_crazyflie.scenarios import ALL, SCENARIOS, Scenario
from tests.kill.lives import eventually
from tests.kill.trial import gateway_of

_LEAVES = 180.0
"""Seconds within which the gateway ends, once the app has."""


def fly(scenario: Scenario, source: Path, folder: Path) -> tuple[Flight, list[str]]:
    """Fly a scenario to its end; return the flight, and what was wrong with it."""
    world = folder / "drones"
    uris = process.start(world, homes(len(ALL)), COMMAND)
    write(folder, missions(tours(3)), fleet(len(ALL), uris))
    flight = Flight(app=RETRY, source=source, folder=folder, world=world)
    try:
        if scenario.before is not None:
            scenario.before(flight)
        flight.start()
        if scenario.during is not None:
            scenario.during(flight)
        code = flight.wait()
        left = list(gateway_left(flight))
        return flight, [*_wrong(scenario, flight, code), *left]
    except AssertionError as error:
        return flight, [str(error)]
    finally:
        flight.end()


def gateway_left(flight: Flight) -> Iterator[str]:
    """Wait until the gateway ends, after the app; yield what is wrong with that."""
    began = time.monotonic()
    ends = eventually(lambda: gateway_of(flight.journal) is None, _LEAVES)
    flight.notes.append(f"gateway left after {time.monotonic() - began:.0f} s")
    if not ends:
        yield "the gateway does not end"


def _wrong(scenario: Scenario, flight: Flight, code: int) -> Iterator[str]:
    """Yield what is wrong with a flight that has ended."""
    if code != scenario.code:
        yield f"exit code {code}"
    for mission, status in flight.ends().items():
        if status != "COMPLETED":
            yield f"{mission} ended as {status}"
    reasons = [event["reason"] for event in flight.events if event["event"] == "trip.failed"]
    flight.notes.extend(dict.fromkeys(reasons))
    if scenario.fails and not any(re.search(scenario.fails, reason) for reason in reasons):
        yield f"no trip has failed with {scenario.fails!r}"
    if not scenario.fails and reasons:
        yield "a trip has failed"
    yield from unmeant(flight.deeds, flight.trace, SIZE, scenario.falls)
    if "Traceback" in flight.told:
        yield "a traceback was printed"


def main() -> int:
    """Fly the scenarios that are named, or all; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.flights_crazyflie.campaign", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="SCENARIO", help="default: all")
    names = parser.parse_args().names
    known = [scenario.name for scenario in SCENARIOS]
    if any(name not in known for name in names):
        parser.error(f"there are {', '.join(known)}")
    folder = Path(mkdtemp(prefix="crazyflies-"))
    source = quick_package(folder / "package")
    print(f"flights in {folder}", flush=True)
    bad = 0
    for number, scenario in enumerate(SCENARIOS):
        if names and scenario.name not in names:
            continue
        began = time.monotonic()
        flight, wrong = fly(scenario, source, folder / str(number))
        bad += bool(wrong)
        took = time.monotonic() - began
        said = "; ".join(flight.notes)
        print(f"{scenario.name:28} {'WRONG' if wrong else 'as meant':9} {took:4.0f} s  {said}")
        for one in wrong:
            print(f"    {one}")
        sys.stdout.flush()
    print(f"{bad} of {len(names or SCENARIOS)} are wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
