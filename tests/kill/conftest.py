"""Flights of real processes, a folder each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.flying import compiled, compiled_file
from tests.kill.lives import Flight
from tests.kill.plans import PLANS, Plan
from tests.kill.trial import end_gateway

APP = """pluto 1

app painter "Paint what the missions say" {
  category sprayer can spray

  action spray once

  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor

  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""

HOOKS = '''"""An action that takes its time, and can hold up everything."""

import asyncio
import os
import time
from pathlib import Path

HERE = Path(os.environ["PAINTER"])


async def spray(drone, trip, context):
    """Paint, and write down that it was done."""
    (HERE / "begun").touch()
    while not (HERE / "go").exists():
        if (HERE / "block").exists():
            time.sleep(0.05)  # as hooks should not: nothing else can happen meanwhile
        else:
            await asyncio.sleep(0.01)
    with (HERE / "painted").open("a") as file:
        print(trip.name, file=file)
'''

MISSIONS = """
[[mission]]
name = "wall"
[[mission.trip]]
name = "left"
action = "spray"
target = [2.0, 1.0]
[[mission.trip]]
name = "right"
action = "spray"
target = [3.0, 1.0]
"""

FLEET = """
[map]
size = [5.0, 4.0]
cruise_height = 1.0
[[drone]]
id = "d0"
home = [0.5, 0.5]
"""

NewFlight = Callable[[float], Flight]


@pytest.fixture(scope="session")
def plan() -> Plan:
    """An app with delays and retries, whose three missions carry things."""
    return next(plan for plan in PLANS if plan.app == "drugs_distribution_retry")


@pytest.fixture(scope="session")
def source(plan: Plan, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app's package is imported from."""
    return compiled(plan.app, tmp_path_factory.mktemp("package")) / "src"


@pytest.fixture(scope="session")
def painter(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that an app with an action of its own is imported from."""
    folder = tmp_path_factory.mktemp("painter")
    (folder / "app.pluto").write_text(APP)
    (folder / "hooks.py").write_text(HOOKS)
    return compiled_file(folder / "app.pluto", folder / "package") / "src"


@pytest.fixture
def painting(painter: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Flight]:
    """Prepare a flight of that app."""
    monkeypatch.setenv("PAINTER", str(tmp_path))
    (tmp_path / "missions.toml").write_text(MISSIONS)
    (tmp_path / "fleet.toml").write_text(FLEET)
    flight = Flight(app="painter", source=painter, folder=tmp_path, speed=20.0)
    yield flight
    flight.end()
    end_gateway(flight.journal)


@pytest.fixture
def new_flight(plan: Plan, source: Path, tmp_path: Path) -> Iterator[NewFlight]:
    """Prepare flights at some speed; none of their processes is left behind."""
    flights: list[Flight] = []

    def new(speed: float) -> Flight:
        folder = tmp_path / str(len(flights))
        folder.mkdir()
        plan.write(folder)
        flights.append(Flight(app=plan.app, source=source, folder=folder, speed=speed))
        return flights[-1]

    yield new
    for flight in flights:
        flight.end()
        end_gateway(flight.journal)
