"""Flies every scenario with the unmodified cflib, and prints what came of it.

    python -m tests.flights_crazyflie.campaign
    python -m tests.flights_crazyflie.campaign "tumbles" "link lost for 5 s"
    python -m tests.flights_crazyflie.campaign --at-once 3

Each flight has a folder of its own, which is named where something was wrong.
"""

from __future__ import annotations

import re
import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import repeat
from pathlib import Path
from tempfile import mkdtemp

from pluto_fleet.crtp import process
from tests.apart import apart
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
    uris = process.start(world, homes(len(ALL)))
    write(folder, missions(tours(3)), fleet(len(ALL), uris))
    if scenario.speed is not None:
        source = quick_package(folder / "package", scenario.speed)
    flight = Flight(app=RETRY, source=source, folder=folder, world=world)
    try:
        if scenario.before is not None:
            scenario.before(flight)
        flight.start()
        if scenario.during is not None:
            scenario.during(flight)
        code = flight.see_through()
        if scenario.refused:
            return flight, list(_unrefused(scenario, flight, code))
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


def _unrefused(scenario: Scenario, flight: Flight, code: int) -> Iterator[str]:
    """Yield what is wrong with a flight that must not have begun."""
    if code != scenario.code:
        yield f"exit code {code}"
    if not re.search(scenario.refused, flight.told):
        yield f"nothing is said of {scenario.refused!r}"
    if any(command.what in ("arm", "takeoff") for command in flight.commands):
        yield "a drone was armed"


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
    yield from unmeant(flight.commands, flight.trace, SIZE, scenario.falls)
    if "Traceback" in flight.told:
        yield "a traceback was printed"


def _flown(scenario: Scenario, source: Path, folder: Path) -> list[str]:
    """Fly a scenario; return a line on it, and one for each thing that was wrong."""
    began = time.monotonic()
    flight, wrong = fly(scenario, source, folder)
    took, said = time.monotonic() - began, "; ".join(flight.notes)
    how = "WRONG" if wrong else "as meant"
    return [f"{scenario.name:29} {how:9} {took:4.0f} s  {said}", *wrong]


def main() -> int:
    """Fly the scenarios that are named, or all; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.flights_crazyflie.campaign", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="SCENARIO", help="default: all")
    parser.add_argument(
        "--at-once", type=int, default=1, metavar="N", help="fly N side by side (default: 1)"
    )
    options = parser.parse_args()
    names = options.names
    known = [scenario.name for scenario in SCENARIOS]
    if any(name not in known for name in names):
        parser.error(f"there are {', '.join(known)}")
    folder = Path(mkdtemp(prefix="crazyflies-"))
    source = quick_package(folder / "package")
    print(f"flights in {folder}", flush=True)
    chosen = [one for one in SCENARIOS if not names or one.name in names]
    folders = [folder / str(number) for number, _ in enumerate(chosen)]
    bad = 0
    with ThreadPoolExecutor(options.at_once) as pool:
        for lines in pool.map(_flown, chosen, repeat(source), folders):
            bad += len(lines) > 1
            print(*lines, sep="\n    ", flush=True)
    print(f"{bad} of {len(chosen)} are wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    with apart():
        sys.exit(main())
