"""An app with events: told from outside, seen on the way, followed, and with another drone that takes over."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from tests.kill.plans import plan, source_of

HOOKS = '''"""What is seen on the way, and what is made of it."""

import os
from pathlib import Path

from . import Mission, Trip

LOOKS = Path(os.environ["FLIGHT"]) / "looks"


async def look(drone, trip, context):
    """Write down that it goes on, and say whom the camera sees."""
    camera = context.live(drone)
    while True:
        with LOOKS.open("a") as file:
            print(context.now, trip.name, file=file)
        for seen in await camera.sees():
            context.emit("intruder", id=f"seen {seen.track}", at=seen.at, track=seen.track)
        await context.sleep(0.5)


def check(event, context):
    """Photograph the place, or who walks there."""
    photo = Trip(
        name="photo",
        action="take_photo",
        target=event.at,
        track=event.track,
        lost_after=10.0,
    )
    return Mission(name=event.id, trips=[photo])


def stay(event, context):
    """Stay longer than one battery lasts."""
    follow = Trip(
        name="follow",
        action="follow",
        target=event.at,
        track=event.track,
        lost_after=10.0,
        parameters={"for": 110.0, "every": 5.0},
    )
    return Mission(name=event.id, trips=[follow])
'''


class Look(NamedTuple):
    """A moment at which an action along the way went on."""

    time: float
    trip: str


def lookout_in(folder: Path) -> Path:
    """Compile the app into a folder, and return the one that it is imported from."""
    return source_of("lookout", HOOKS, folder)


def looks(folder: Path) -> Iterator[Look]:
    """Yield each moment that an action along the way has written down."""
    file = folder / "looks"
    # the last line may have been cut short
    for line in file.read_text().split("\n")[:-1] if file.exists() else ():
        time, trip = line.split(" ", 1)
        yield Look(float(time), trip)


LOOKOUT = plan("lookout", event="smoke")
"""Each trip with an action on the way has a name of its own."""
