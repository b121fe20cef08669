"""Flies every scenario of faults with MAVSDK and simulated autopilots of both makes, and prints what came of it.

    python -m tests.flights_mavlink.campaign
    python -m tests.flights_mavlink.campaign "a motor dies, px4" --times 3
    python -m tests.flights_mavlink.campaign --at-once 4

Each flight has a folder of its own, which is named where something was wrong.
"""

from __future__ import annotations

import json
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from pluto_fleet.autopilot import process
from pluto_fleet.autopilot.process import SimulatedFleet
from pluto_fleet.files.stand_ins import SOMEWHERE
from pluto_fleet.shared.domain.errors import BadInput
from tests.apart import apart
from tests.flights_crazyflie.campaign import seen_through
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import badly_ended, not_as_meant
from tests.kill.trial import gateway_of
from tests.kit.apps import compiled_file
from tests.kit.campaign import Campaign

APP = "surveys"
HERE = Path(__file__).parent
MAKES = {"m1": "px4", "m2": "ardupilot", "m3": "px4", "m4": "ardupilot"}
"""The vehicles; three missions are flown, so that one of them has time."""
HOMES = {id: (10.0 * number - 5.0, 5.0, 0.0) for number, id in enumerate(MAKES, 1)}
RETURNS = {"px4": {"RTL_RETURN_ALT": 6.0}, "ardupilot": {"RTL_ALT": 600.0}}
"""Lower than they come, for these flights take the time that they take."""
_LIMIT = 400.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fault, and what must come of it."""

    name: str
    before: str = ""
    in_flight: str = ""
    value: float | bool | str = True
    seconds: float = 0.0
    after: str = ""
    fails: str = ""
    falls: bool = False
    parameters: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


@dataclass(kw_only=True)
class Vehicles(Flight):
    """A flight of simulated vehicles that speak MAVLink, one of which has a fault."""

    scenario: Scenario
    broken: str

    @property
    def state(self) -> Mapping[str, Mapping[str, Any]]:
        found: Mapping[str, Mapping[str, Any]] = json.loads(process.told(self.air, "state"))[
            "vehicles"
        ]
        return found

    def airborne(self) -> list[str]:
        with suppress(BadInput):
            return [id for id, one in self.state.items() if one["at"][2] > 0.1]
        return []

    def break_it(self, fault: str, value: float | bool | str | list[float] = True) -> None:
        process.told(self.air, "fault", drone=self.broken, name=fault, value=value)

    def prepare(self) -> None:
        """Let go wrong what does so before the app starts."""
        for id, make in MAKES.items():
            given = {**RETURNS[make], **self.scenario.parameters.get(make, {})}
            for name, value in given.items():
                process.told(self.air, "fault", drone=id, name=f"parameter {name}", value=value)
        if self.scenario.before:
            self.break_it(self.scenario.before, self.scenario.value)

    def go_on(self) -> None:
        """Let go wrong what does so in flight."""
        scenario = self.scenario
        if not scenario.in_flight and not scenario.after:
            return
        self.until_up(self.broken, 3.0)
        self.goes_on(1.0)
        if scenario.in_flight:
            self.break_it(scenario.in_flight, scenario.value)
        if scenario.seconds:
            self.goes_on(scenario.seconds)
            self.break_it(scenario.in_flight, False)
        if scenario.after:
            getattr(self, scenario.after)()

    def lands(self) -> None:
        """Wait until it has landed by itself; then let it be heard again."""
        self.until(lambda: self.broken not in self.airborne(), 60.0)
        self.break_it("silent", False)

    def kill_brain(self) -> None:
        """Kill the app; the gateway must land all vehicles; then go on."""
        self.kill()
        self.until(lambda: not self.airborne())
        self.start()

    def kill_the_gateway(self) -> None:
        """Kill the gateway; the app must start it again."""
        old = gateway_of(self.journal)
        super().kill_gateway()
        self.until(lambda: gateway_of(self.journal) not in (None, old), 30.0)

    def end(self) -> None:
        super().end()
        process.end(self.air)


def fly(scenario: Scenario, broken: str, source: Path, folder: Path) -> tuple[Vehicles, list[str]]:
    """Fly a scenario to its end; return the flight, and what was wrong with it."""
    world = folder / "vehicles"
    fleet = SimulatedFleet(
        plane=SOMEWHERE,
        homes=HOMES,
        makes=MAKES,
        flights=dict.fromkeys(HOMES, 600.0),
        charges=dict.fromkeys(HOMES, 60.0),
    )
    uris = process.start(world, fleet)
    write(folder, uris)
    flight = Vehicles(
        app=APP, source=source, folder=folder, world=world, scenario=scenario, broken=broken
    )
    flight.prepare()

    def judged(code: int) -> Iterator[str]:
        return _wrong(scenario, flight, code)

    return flight, seen_through(flight, judged, lambda _: flight.go_on(), _LIMIT)


def write(folder: Path, uris: Mapping[str, str]) -> None:
    """Write the files of a flight: two photos in each of three missions, before the first three vehicles."""
    drones = "".join(
        f'[[drone]]\nid = "{id}"\nhome = {list(HOMES[id][:2])}\nuri = "{uri}"\n'
        for id, uri in uris.items()
    )
    place = (
        f"{{ latitude = {SOMEWHERE.latitude}, longitude = {SOMEWHERE.longitude},"
        f" altitude = {SOMEWHERE.altitude} }}"
    )
    (folder / "fleet.toml").write_text(
        f"[map]\nsize = [60, 60]\ncruise_height = 5.0\nceiling = 15.0\norigin = {place}\n"
        f'[fleet]\napart = 3.0\nnavigation = "mavlink"\n[motion]\nlegs = "steady"\n{drones}'
    )
    (folder / "missions.toml").write_text(
        "".join(
            f'[[mission]]\nname = "{id}"\n'
            + "".join(
                f'[[mission.trip]]\naction = "take_photo"\ntarget = [{HOMES[id][0]}, {y}]\n'
                for y in (25.0, 40.0)
            )
            for id in ("m1", "m2", "m3")
        )
    )


def _wrong(scenario: Scenario, flight: Vehicles, code: int) -> Iterator[str]:
    """Yield what is wrong with a flight that has ended."""
    yield from badly_ended(flight, code)
    yield from not_as_meant(flight, scenario.fails)
    yield from (f"{id} is in the air" for id in flight.airborne())
    taken = 0
    for id, one in flight.state.items():
        taken += len(one["photos"])
        if one["fell"] and not (scenario.falls and id == flight.broken):
            yield f"{id} fell"
    done = sum(event["event"] == "trip.completed" for event in flight.events)
    failed = sum(event["event"] == "trip.failed" for event in flight.events)
    if not done <= taken <= done + failed:
        yield f"{taken} photos were taken for {done} trips"


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the scenarios that are named, or all; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_mavlink.campaign", __doc__)
    campaign.unit = "flight"
    known = [
        Scenario(**one)
        for one in tomllib.loads((HERE / "scenarios.toml").read_text(encoding="utf-8"))["scenario"]
    ]
    by_name = {
        f"{scenario.name}, {MAKES[broken]}": (scenario, broken)
        for scenario in known
        for broken in ("m1", "m2")
    }
    campaign.option("names", nargs="*", metavar="SCENARIO", help="default: all")
    campaign.option("--times", type=int, default=1, metavar="N", help="how often (default: 1)")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    names = options.names or list(by_name)
    if unknown := [name for name in names if name not in by_name]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(by_name)}")
    folder = Path(mkdtemp(prefix="vehicles-"))
    source = compiled_file(HERE / "app.pluto", folder / "package") / "src"
    print(f"flights in {folder}", flush=True)

    def flown(case: tuple[str, int]) -> tuple[Vehicles, list[str]]:
        name, number = case
        where = folder / f"{re.sub('[^a-z0-9]+', '-', name)}-{number}"
        return fly(*by_name[name], source, where)

    cases = [(name, number) for number in range(options.times) for name in names]
    for (name, _), (flight, wrong) in campaign.each(flown, cases, threads=True):
        print(f"{name:50} {'; '.join(flight.notes)}", flush=True)
        if wrong:
            campaign.found(name, *wrong)
    return campaign.over()


if __name__ == "__main__":
    with apart():
        sys.exit(main())
