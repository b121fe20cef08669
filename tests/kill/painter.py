"""An app with an action of its own that may not be repeated: it is not seen whether it was done."""

from __future__ import annotations

from pathlib import Path

from tests.kill.plans import Plan, fleet, trip
from tests.kit.apps import compiled_file

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

HERE = Path(os.environ["FLIGHT"])


async def spray(drone, trip, context):
    """Paint, and write down that it was done."""
    (HERE / "begun").touch()
    while not (HERE / "go").exists():
        if (HERE / "block").exists():
            time.sleep(0.05)  # as hooks should not: nothing else can happen meanwhile
        else:
            await asyncio.sleep(0.01)
    await context.sleep(3)
    with (HERE / "painted").open("a") as file:
        print(trip.name, file=file)
    await context.sleep(1)
'''

PAINTED = "painted"
"""Where its hook writes a line for each trip whose action was done."""


def painter_in(folder: Path) -> Path:
    """Compile the app into a folder, and return the package's own."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "app.pluto").write_text(APP)
    (folder / "hooks.py").write_text(HOOKS)
    return compiled_file(folder / "app.pluto", folder / "package")


def painted(folder: Path) -> list[str]:
    """Return the trips whose action was done, as often as it was."""
    file = folder / PAINTED
    return file.read_text().split() if file.exists() else []


WALL = Plan(
    app="painter",
    missions='[[mission]]\nname = "wall"\n'
    + trip("left", "spray", "2.0, 1.0")
    + trip("right", "spray", "3.0, 1.0"),
    fleet=fleet("sprayer"),
)

HOUSE = Plan(
    app="painter",
    missions="".join(
        f'[[mission]]\nname = "{side}"\n'
        + trip(f"{side}-low", "spray", f"{x}, 1.0")
        + trip(f"{side}-high", "spray", f"{x}, 2.0")
        for x, side in ((1.0, "west"), (2.5, "north"), (4.0, "east"))
    ),
    fleet=fleet("sprayer sprayer"),
)
"""Each trip has a name of its own."""
