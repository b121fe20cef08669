"""Ten Crazyflies in the air at once, crossing each other's ways home, and then Stop, as one flight.

    python -m tests.flights_crazyflie.together
    python -m tests.flights_crazyflie.together --speed 1.5

flies it for Land and for return to launch, and prints how long it took and how near they came.
"""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import dist
from pathlib import Path
from tempfile import mkdtemp

from pluto_fleet.crazyflie.trajectory import DEFAULT_LIMIT, SpeedLimits, shortest_duration
from pluto_fleet.crtp.flight_log import CommandRecord, Point
from pluto_fleet.drones.vehicle import CLIMB_LIMIT
from pluto_fleet.journal.place import commands_note
from pluto_fleet.process.ipc import ask
from pluto_fleet.shared.domain.motion import SHORTEST
from pluto_fleet.shared.hooks.plain_data import point_of
from tests.apart import apart
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import astray, dropped, left_in_the_air, nearest
from tests.flights_crazyflie.plans import (
    DISTRIBUTION,
    SIZE,
    Plan,
    fleet,
    homes,
    missions,
    quick_package,
    write,
)
from tests.flights_crazyflie.plans import targets as targets_of

TEN = 10
APART = 0.5
LATER = 2.0
"""Seconds that the last may be down after the slowest would be alone."""
STOPPED = 130
_LIMITS = SpeedLimits((DEFAULT_LIMIT, DEFAULT_LIMIT, DEFAULT_LIMIT))
_SETTLES = 0.8
"""Seconds that a drone is behind each of its courses, and must then have been at rest."""
_HOVERS = "[navigation.crazyflie]\nmeasure_seconds = 100\n"


@dataclass(frozen=True, slots=True)
class Figures:
    """What came of it."""

    how: str
    last: float
    """Seconds from the Stop until the last was down."""
    slowest: float
    """Seconds that the slowest would have taken alone."""
    least: float
    """Metres to which two have come near in the air."""
    problems: tuple[str, ...]

    def __str__(self) -> str:
        return (
            f"{self.how}: ten down in {self.last:.1f} s, the slowest alone {self.slowest:.1f} s,"
            f" never nearer than {self.least:.2f} m"
        )


def crossing() -> Plan:
    """Return a mission a drone: each measures before the home of its neighbour."""
    places = list(homes(TEN).values())
    aims = [places[row * 5 + (column + 1) % 5] for row in range(2) for column in range(5)]
    return {
        (f"M{number}", "t"): ("measure", (x, y + 1.2), "")
        for number, (x, y, _) in enumerate(aims, 1)
    }


AIMS = list(targets_of(crossing()).values())


def stopped(how: str, source: Path, folder: Path, speed: float) -> Figures:
    """Fly ten drones to where they measure, stop them so, and return what came of it."""
    write(folder, missions(crossing()), fleet(TEN) + _HOVERS)
    flight = Flight(app=DISTRIBUTION, source=source, folder=folder, drones=TEN)
    try:
        flight.start()
        flight.until(lambda: _all_there(flight), 120.0)
        places = {id: point_of(one["at"]) for id, one in flight.state.items()}
        began = time.monotonic()
        ask(commands_note(flight.journal), {"command": "stop", "how": how}, 90.0)
        code = flight.see_through()
        commands = flight.commands
        problems = [*dropped(commands), *left_in_the_air(commands), *astray(commands, SIZE)]
        if code != STOPPED:
            problems.append(f"exit code {code}")
        for id, home in homes(TEN).items():
            if how == "rtl" and dist(flight.state[id]["at"][:2], home[:2]) > 0.2:
                problems.append(f"{id} is not home")
        least, who = nearest(flight.trace)
        if least < APART:
            problems.append(f"{least:.2f} m apart: {who}")
        goals = homes(TEN) if how == "rtl" else {}
        flown = Counter(
            command.drone
            for command in commands
            if command.what == "go_to" and command.time > began
        )
        alone = (_alone(at, goals.get(id), speed, flown[id]) for id, at in places.items())
        return Figures(how, _last(commands) - began, max(alone), least, tuple(problems))
    finally:
        flight.end()


def _all_there(flight: Flight) -> bool:
    """Whether all hover where they measure."""
    if len(flight.airborne()) < TEN:
        return False
    places = [point_of(one["at"]) for one in flight.state.values()]
    return all(any(dist(place, there) < 0.15 for place in places) for there in AIMS)


def _alone(where: Point, home: Point | None, speed: float, courses: int) -> float:
    """Return the seconds that a drone takes to come down with no other in the air."""
    x, y, z = where
    way = 0.0 if home is None else shortest_duration(dist((x, y), home[:2]), speed)
    return SHORTEST + way + _LIMITS.seconds_down(z, CLIMB_LIMIT) + _SETTLES * courses


def _last(commands: Sequence[CommandRecord]) -> float:
    """Return when the last was down."""
    return max(command.time for command in commands if command.what == "down")


def main() -> int:
    """Print the figures of both; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.flights_crazyflie.together", description=__doc__)
    parser.add_argument("--speed", type=float, default=0.5, help="m/s at most (default: 0.5)")
    speed = parser.parse_args().speed
    folder = Path(mkdtemp(prefix="crazyflies-"))
    source = quick_package(folder / "package", speed, DISTRIBUTION)
    bad = False
    for how in ("land", "rtl"):
        figures = stopped(how, source, folder / how, speed)
        late = figures.last - figures.slowest > LATER
        bad = bad or late or bool(figures.problems)
        print(f"{figures}{', TOO LATE' if late else ''}", *figures.problems, sep="\n  ", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    with apart():
        sys.exit(main())
