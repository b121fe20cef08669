"""A large flight: fifty drones on a field, two hundred missions that want them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

SOURCE = """\
pluto 1
app watched "A flight that many watch" {
  category scout(speed: 1 m/s, flight_time: 15 min) can measure
  create = MissionCreator
  allocate = DroneAllocator(policy: nearest)
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 3)
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  [watch, retry] -> end otherwise
}
"""

RUNTIME = Path(__file__).parents[2] / "runtime"

SIDE = 60.0
"""Metres of the field, each way."""

TRIPS = 4
"""Of each mission: more than are flown while this is measured."""


def fleet(drones: int) -> str:
    """Return the fleet file: homes in rows along one side, a metre apart."""
    tables = [f"[map]\nsize = [{SIDE}, {SIDE}]\ncruise_height = 1.5\n\n[fleet]\napart = 0.3\n"]
    for number in range(drones):
        row, place = divmod(number, 25)
        home = f"[{5 + 2 * place}.0, {1 + row}.0]"
        tables.append(f'[[drone]]\nid = "cf{number + 1}"\nhome = {home}\n')
    return "\n".join(tables)


def plan(missions: int) -> list[dict[str, object]]:
    """Return the missions, as the page would send them."""
    return [
        {
            "key": f"mission{number:04}",
            "name": f"Mission {number + 1}",
            "trips": [_trip(number, trip) for trip in range(TRIPS)],
        }
        for number in range(missions)
    ]


def _trip(mission: int, trip: int) -> dict[str, object]:
    """Spread the places evenly: far enough for a flight of half a minute and more."""
    x = 2 + (mission * 7 + trip * 13) % int(SIDE - 4)
    y = 8 + (mission * 11 + trip * 17) % int(SIDE - 10)
    return {
        "key": f"trip{mission:04}x{trip}",
        "name": "ABCD"[trip],
        "action": "measure",
        "target": [float(x), float(y)],
        "parameters": {},
        "item": None,
    }


def installed(folder: Path) -> Path:
    """Install the library as users have it, its pages minified, and return where it is imported from."""
    words = ["install", "--quiet", "--no-deps", "--target", str(folder / "library"), str(RUNTIME)]
    subprocess.run([sys.executable, "-m", "pip", *words], check=True)
    return folder / "library"


def compiled(folder: Path) -> Path:
    """Compile the app from the command line, and return where its package is imported from."""
    (folder / "watched.pluto").write_text(SOURCE)
    compiler = [sys.executable, "-m", "plutoc", "compile", str(folder / "watched.pluto")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    subprocess.run(compiler, check=True, env=environment, stdout=subprocess.DEVNULL)
    return folder / "watched" / "src"
