"""What does a survey of a field take here, beside what a common planner of ground stations makes of it?

`python benchmarks/survey.py` has a field of 400 × 300 m photographed from 60 m at 5 m/s, by a camera of 13.2 × 8.8 mm behind 8.8 mm,
with 75 % in common with the next photo and 70 % with the next lane, as that planner has it by default. Printed are photos, the metres from the
first to the last of them, minutes in the air with all take-offs and landings, how many of these there are, and batteries of 20 minutes, of which all but a reserve of 20 % is flown:

- as QGroundControl says it, from its formulas: `CameraCalc.cc` (what a photo shows, and what lies between two), `SurveyComplexItem.cc` (transects, photos),
  `MissionFlightStatusCalculator.cc` (minutes), with its defaults: 10 m to turn around, photos there too, up at 3 m/s and down at 1 m/s;
- the same way by our model of how vehicles move, PX4's, which brakes at corners;
- our lanes `on_the_way`, `side_by_side` as well, and a stop at each place, simulated without spread by one vehicle whose battery is swapped at home.

Ends with 1 if a mission was not completed, or our lanes take more photos or metres than the planner's.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan, ceil, degrees, dist
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

sys.path[:0] = [str(Path(__file__).parents[1])]

import tests  # noqa: F401  # first: all that follows shares one brain
from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile, load_fleet
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import read
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.domain.motion import STEADY, Motion
from pluto_fleet.shared.domain.trace import Event
from tests.kit import apps

WIDE = 400.0
DEEP = 300.0
AT = 60.0
"""Where the field's corner lies on the map, in both directions."""
HOME = (50.0, 50.0)
HEIGHT = 60.0
SPEED = 5.0
SENSOR = (13.2, 8.8)
FOCAL = 8.8
"""Of the camera, in millimetres; its longer side lies across the way."""
AHEAD = 0.75
ASIDE = 0.70
BATTERY = 1200.0
RESERVE = 0.2

TURN_AROUND = 10.0
ASCENT = 3.0
DESCENT = 1.0
"""Defaults of the planner, in metres and metres a second."""
BEYOND = 2000.0
"""Metres by which the planner's lines are longer than the field, which decides where its first one lies."""

SOURCE = f"""\
pluto 1
app survey_bench "A survey" {{
  category surveyor(speed: {SPEED} m/s, flight_time: {BATTERY / 60} min, charge_time: 1 s, reserve: {RESERVE:.0%}) can take_photo
  action take_photo along
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end when FAILED
  watch -> end otherwise
}}
"""
FLEET = f"""\
[map]
size = [{WIDE + 2 * AT}, {DEEP + 2 * AT}]
cruise_height = {HEIGHT}
ceiling = {HEIGHT + 20}
[motion]
legs = "steady"
[[drone]]
id = "m1"
home = [{HOME[0]}, {HOME[1]}]
"""
MISSIONS = """\
[[mission]]
name = "Field"
  [[mission.area]]
  polygon = [[{x}, {y}], [{right}, {y}], [{right}, {top}], [{x}, {top}]]
  action = "take_photo"
  overlap = ["{ahead:.0%}", "{aside:.0%}"]
  camera_view = ["{view[0]} deg", "{view[1]} deg"]
  {how}
"""
ON_THE_WAY = "on_the_way = true"
WAYS = {
    "on the way, onward": (ON_THE_WAY, "onward"),
    "on the way, next": (ON_THE_WAY, "next"),
    "a stop at each place, onward": ("", "onward"),
    "a stop at each place, next": ("", "next"),
}
"""How the area is flown, and where its vehicle goes after a trip."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """What a survey takes."""

    photos: int
    metres: float
    seconds: float
    """From the first take-off to the last landing, without what the swap of a battery takes."""
    landings: int
    completed: bool = True

    @property
    def batteries(self) -> float:
        """How many it takes, of which only what is above the reserve is flown."""
        return self.seconds / (BATTERY * (1 - RESERVE))


Corner = tuple[float, float]


def transects() -> list[tuple[Corner, Corner]]:
    """Return the planner's transects, along the longer side, each with its turn-arounds."""
    apart = HEIGHT * SENSOR[0] / FOCAL * (1 - ASIDE)
    first = DEEP / 2 - (max(WIDE, DEEP) + BEYOND) / 2
    offsets = (first + number * apart for number in range(ceil(2 * -first / apart) + 1))
    ends = ((-TURN_AROUND, y) for y in offsets if 0 <= y <= DEEP)
    lanes = [((x, y), (WIDE - x, y)) for x, y in ends]
    return [(a, b) if number % 2 == 0 else (b, a) for number, (a, b) in enumerate(lanes)]


def planned(motion: Motion | None) -> Survey:
    """Return what the planner says; with a motion, the time that it takes to fly that."""
    way = [point for lane in transects() for point in lane]
    inside = sum(map(dist, way, way[1:]))
    every = HEIGHT * SENSOR[1] / FOCAL * (1 - AHEAD)
    home = (HOME[0] - AT, HOME[1] - AT)
    legs = [dist(a, b) for a, b in pairwise([home, *way, home])]
    if motion is None:
        seconds = HEIGHT / ASCENT + sum(legs) / SPEED + HEIGHT / DESCENT
    else:
        up = motion.rises(HEIGHT, SPEED)
        seconds = up + sum(motion.flies(leg, SPEED) for leg in legs) + motion.lands(HEIGHT, SPEED)
    return Survey(photos=ceil(inside / every), metres=inside, seconds=seconds, landings=1)


def flown(app: App, fleet: FleetFile, file: Path) -> Survey:
    """Return what comes of a missions file, flown by one vehicle."""
    document = read(file)
    missions = missions_of(document, app, fleet.airspace)
    [area] = document.areas
    outcome = simulate(app, missions, fleet, seed=0, faults=Faults(), until=None, on_event=None)
    return Survey(
        photos=len(outcome.results),
        metres=area.metres,
        seconds=max(float(str(event["t"])) for event in outcome.events),
        landings=sum(
            event["event"] == "drone.free" and _at(event)[2] == 0 for event in outcome.events
        ),
        completed=outcome.completed,
    )


def _at(event: Event) -> Sequence[float]:
    """Return where a drone was at an event."""
    at: Any = event["at"]
    return [*map(float, at)]


def ours() -> Iterator[tuple[str, Survey]]:
    """Yield what each of our ways takes."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / "app.pluto"
        source.write_text(SOURCE, encoding="utf-8")
        (folder / "fleet.toml").write_text(FLEET, encoding="utf-8")
        known = apps.imported("survey_bench", apps.compiled_file(source, folder / "package"))
        fleet = load_fleet(folder / "fleet.toml", known)
        fleet = replace(fleet, motion=fleet.motion.exact)
        app = moving(known, fleet.motion)
        view = [degrees(2 * atan(side / 2 / FOCAL)) for side in SENSOR[::-1]]
        for called, (how, after) in WAYS.items():
            text = MISSIONS.format(
                x=AT,
                y=AT,
                right=AT + WIDE,
                top=AT + DEEP,
                ahead=AHEAD,
                aside=ASIDE,
                view=view,
                how=how,
            )
            (folder / "missions.toml").write_text(text, encoding="utf-8")
            sent = replace(fleet, after_trip=AfterTrip(after))
            yield called, flown(app, sent, folder / "missions.toml")


def main(arguments: Sequence[str]) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.parse_args(arguments)
    planner = planned(None)
    surveys = {"QGroundControl, as it says": planner, "the same, as we reckon": planned(STEADY)}
    surveys |= ours()
    print(f"{'':30}{'photos':>8}{'metres':>8}{'minutes':>9}{'landings':>10}{'batteries':>11}")
    for called, one in surveys.items():
        counts = f"{one.photos:>8}{one.metres:>8.0f}{one.seconds / 60:>9.1f}{one.landings:>10}"
        print(f"{called:30}{counts}{one.batteries:>11.2f}")
    best = surveys["on the way, onward"]
    is_worse = best.photos > planner.photos or best.metres > planner.metres
    return int(is_worse or not all(one.completed for one in surveys.values()))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
