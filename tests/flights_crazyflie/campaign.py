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
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import mkdtemp

from pluto_fleet.crtp import process
from tests.apart import apart
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import badly_ended, not_as_meant, unmeant
from tests.flights_crazyflie.plans import RETRY, SIZE, homes, plan, quick_package, write
from tests.flights_crazyflie.scenarios import SCENARIOS, Scenario
from tests.kill.lives import PATIENCE, eventually
from tests.kill.trial import gateway_of
from tests.kit.campaign import Campaign

_LEAVES = 180.0
"""Seconds within which the gateway ends, once the app has."""


def fly(scenario: Scenario, source: Path, folder: Path) -> tuple[Flight, list[str]]:
    """Fly a scenario to its end; return the flight, and what was wrong with it."""
    world = folder / "drones"
    missions, fleet = plan("three_tours")
    for drone, uri in process.start(world, homes(fleet)).items():
        fleet = fleet.replace(f"URI {drone}", uri)
    write(folder, missions, fleet)
    if scenario.speed is not None:
        source = quick_package(folder / "package", scenario.speed)
    flight = Flight(app=RETRY, source=source, folder=folder, world=world)
    scenario.begin(flight)

    def judged(code: int) -> Iterator[str]:
        return (_unrefused if scenario.refused else _wrong)(scenario, flight, code)

    return flight, seen_through(flight, judged, scenario.go_on)


def seen_through(
    flight: Flight,
    judged: Callable[[int], Iterator[str]],
    during: Callable[[Flight], None] = lambda _: None,
    limit: float = PATIENCE,
) -> list[str]:
    """Fly to the end, and return what is wrong with it and with the gateway."""
    try:
        flight.start()
        during(flight)
        code = flight.see_through(limit)
        left = list(gateway_left(flight))
        return [*judged(code), *left]
    except AssertionError as error:
        return [str(error)]
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
    yield from badly_ended(flight, code, scenario.code)
    yield from not_as_meant(flight, scenario.fails)
    yield from unmeant(flight.commands, flight.trace, SIZE, tuple(scenario.falls))


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the scenarios that are named, or all; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_crazyflie.campaign", __doc__)
    campaign.unit = "flight"
    by_name = {scenario.name: scenario for scenario in SCENARIOS}
    campaign.option("names", nargs="*", metavar="SCENARIO", help="default: all")
    campaign.side_by_side()
    names = campaign.parse(arguments).names or list(by_name)
    if unknown := [name for name in names if name not in by_name]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(by_name)}")
    folder = Path(mkdtemp(prefix="crazyflies-"))
    source = quick_package(folder / "package")
    print(f"flights in {folder}", flush=True)

    def flown(name: str) -> tuple[Flight, list[str]]:
        return fly(by_name[name], source, folder / name.replace(" ", "-"))

    for name, (flight, wrong) in campaign.each(flown, names, threads=True):
        print(f"{name:31} {'; '.join(flight.notes)}", flush=True)
        if wrong:
            campaign.found(name, *wrong)
    return campaign.over()


if __name__ == "__main__":
    with apart():
        sys.exit(main())
