"""An app with an action of its own that may not be repeated: it is not seen whether it was done."""

from __future__ import annotations

from pathlib import Path

from tests.kill.plans import plan, source_of

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
    """Compile the app into a folder, and return the one that it is imported from."""
    return source_of("painter", HOOKS, folder)


def painted(folder: Path) -> list[str]:
    """Return the trips whose action was done, as often as it was."""
    file = folder / PAINTED
    return file.read_text().split() if file.exists() else []


WALL = plan("wall", app="painter")
HOUSE = plan("house", app="painter")
"""Each trip has a name of its own."""
