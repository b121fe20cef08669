"""Flies every example's own missions with simulated Crazyflies, by the unmodified cflib.

    python -m tests.flights_crazyflie.examples
    python -m tests.flights_crazyflie.examples --as-written alfalfa
    python -m tests.flights_crazyflie.examples drugs_distribution --times 20 --at-once 4

prints a line each. By default drones are fast, and rounds follow each other soon: some ten
minutes in all, three flights at a time. Each has a folder of its own, which is named.
"""

from __future__ import annotations

import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from pluto_fleet.crtp.flight_log import Point
from pluto_fleet.shared.hooks.plain_data import point_of
from tests.apart import apart
from tests.flights_crazyflie.campaign import seen_through
from tests.flights_crazyflie.flight import Event, Flight
from tests.flights_crazyflie.judge import badly_ended, beside_its_target, nearest, unmeant
from tests.flights_crazyflie.plans import quick_package, write
from tests.kit.apps import EXAMPLES, NAMES
from tests.kit.campaign import Campaign

SPEED = 1.0
"""Metres per second that fast drones fly at most: their position controllers allow no more."""
_SLOW, _SOON = 'every = "15 min"', 'every = "2 min"'
_PATIENCE = 3600.0
AT_ONCE = 3

BY_HAND = {
    "alfalfa": """
[[mission]]
name = "By hand"
[[mission.trip]]
action = "pollinate"
parameters = { dose = "20 mg" }
target = [5.2, 7.8]
""",
    "object_finder": """
[[mission]]
name = "slippers: by hand"
[[mission.trip]]
action = "bring_back"
parameters = { thing = "slippers" }
target = [7.0, 5.0]
""",
}
"""What else is flown: no simulated camera sees anything, so nothing else asks for these actions."""


def prepared(app: str, source: Path, folder: Path, *, as_written: bool) -> Flight:
    """Put an example's two files beside its compiled package."""
    missions, fleet = ((EXAMPLES / app / f"{name}.toml").read_text() for name in _FILES)
    if not as_written:
        missions = missions.replace(_SLOW, _SOON)
    write(folder, missions + BY_HAND.get(app, ""), fleet)
    drones = len(tomllib.loads(fleet)["drone"])
    return Flight(app=app, source=source, folder=folder, drones=drones)


_FILES = ("missions", "fleet")


def _wrong(flight: Flight, code: int) -> Iterator[str]:
    """Yield what is wrong with a flight that has ended."""
    events, trace = flight.events, flight.trace
    yield from badly_ended(flight, code)
    done = [event for event in events if event["event"] == "trip.completed"]
    flight.notes.append(f"{len(done)} trips, {len(list(_failures(events)))} failed")
    flight.notes.append(f"nearest {nearest(trace)[0]:.2f} m")
    flown = Counter((event["mission"], event["trip"]) for event in done)
    for (mission, trip), times in _planned(flight).items():
        if flown[mission, trip] < times:
            yield f"{mission}/{trip} was completed {flown[mission, trip]} times, and not {times}"
    size = tomllib.loads((flight.folder / "fleet.toml").read_text())["map"]["size"]
    yield from unmeant(flight.commands, trace, (size[0], size[1]))
    yield from beside_its_target(events, trace, _targets(events))
    yield from _not_really_done(flight, done)


def _failures(events: list[Event]) -> Iterator[str]:
    yield from (event["reason"] for event in events if event["event"] == "trip.failed")


def _planned(flight: Flight) -> Counter[tuple[str, str]]:
    """Return how often each trip of the missions file must be flown."""
    planned: Counter[tuple[str, str]] = Counter()
    for mission in tomllib.loads((flight.folder / "missions.toml").read_text())["mission"]:
        for number, trip in enumerate(mission["trip"], start=1):
            planned[mission["name"], trip.get("name", str(number))] = 1 + mission.get("repeat", 0)
    return planned


def _trips(events: list[Event]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield all trips that there ever were, those that hooks have added included."""
    for event in events:
        if event["event"] in ("mission.created", "mission.extended"):
            trips = event["plan"]["trips"] if "plan" in event else event["trips"]
            yield from ((event["mission"], trip) for trip in trips)


def _targets(events: list[Event]) -> dict[tuple[str, str], Point]:
    return {(mission, trip["name"]): point_of(trip["target"]) for mission, trip in _trips(events)}


def _not_really_done(flight: Flight, done: list[Event]) -> Iterator[str]:
    """Yield which photos are not there, and whether something was picked that no drone picked."""
    actions = {(mission, trip["name"]): trip["action"] for mission, trip in _trips(flight.events)}
    asked = Counter(actions[event["mission"], event["trip"]] for event in done)
    held = Counter(d.values["value"] for d in flight.commands if d.what == "set gripper.closed")
    if (held[1], held[0]) != (asked["pick_item"], asked["release_item"]):
        yield f"grippers were closed {held[1]} times, and opened {held[0]} times"
    for event in done:
        if actions[event["mission"], event["trip"]] == "take_photo":
            file = Path(event["result"]["$photo"]["file"])
            if not file.is_file() or not file.stat().st_size:
                yield f"there is no photo {file}"


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the examples that are named, or all; 1 if anything was wrong."""
    campaign = Campaign("tests.flights_crazyflie.examples", __doc__)
    campaign.unit = "flight"
    campaign.option("names", nargs="*", metavar="EXAMPLE", help="default: all")
    campaign.option("--times", type=int, default=1, help="how often each is flown (default: 1)")
    campaign.side_by_side(AT_ONCE)
    what = "at their own speed: alfalfa takes half an hour"
    campaign.option("--as-written", action="store_true", help=what)
    options = campaign.parse(arguments)
    names = options.names or NAMES
    if unknown := [name for name in names if name not in NAMES]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(NAMES)}")
    folder = Path(mkdtemp(prefix="examples-"))
    print(f"flights in {folder}", flush=True)
    speed = None if options.as_written else SPEED
    sources = {name: quick_package(folder / name / "package", speed, name) for name in names}

    def flown(case: tuple[str, int]) -> tuple[Flight, list[str]]:
        name, number = case
        place = folder / name / str(number)
        flight = prepared(name, sources[name], place, as_written=options.as_written)
        return flight, seen_through(flight, partial(_wrong, flight), limit=_PATIENCE)

    cases = [(name, number) for name in names for number in range(1, options.times + 1)]
    for (name, number), (flight, wrong) in campaign.each(flown, cases, threads=True):
        print(f"{name} {number}: {'; '.join(flight.notes)}", flush=True)
        reasons = _failures(flight.events) if flight.journal.exists() else ()
        for why in dict.fromkeys(reasons):
            print(f"    - {why}")
        if wrong:
            campaign.found(f"{name} {number}", *wrong)
    return campaign.over()


if __name__ == "__main__":
    with apart():
        sys.exit(main())
