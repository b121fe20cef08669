"""The simulated world of a station's newest flight, read without any process that flies it."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pluto_fleet.gateway.process import SETTINGS
from pluto_fleet.gateway.settings import settings_of
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.simulation.body import Body
from pluto_fleet.simulation.world_store import DRONES, WorldStore, this_moment
from tests.kit.station import Station

NEAR = 0.06
"""Metres: places are shown to the centimetre."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """How one drone really is."""

    at: tuple[float, float]
    landed: bool
    why_down: str
    """Why it takes no commands; empty: it does."""


def truth(station: Station, scratch: Path) -> dict[str, Truth]:
    """Return how each drone is at this moment, as a gateway that began now would find it."""
    folder = gateway_folder(station.journals()[-1])
    scratch.mkdir(exist_ok=True)
    shutil.copyfile(folder / DRONES, scratch / DRONES)
    settings = settings_of(json.loads((folder / SETTINGS).read_text()))
    bodies = {drone.id: Body(drone, time.monotonic) for drone in settings.drones}
    WorldStore(scratch, time.monotonic, settings.speed, this_moment).take_over(bodies)
    return {id: _truth(body) for id, body in bodies.items()}


def _truth(body: Body) -> Truth:
    x, y, _ = body.location
    why = "" if body.down is None else str(body.down)
    return Truth(at=(x, y), landed=body.landed, why_down=why)


def disagreements(
    rows: Sequence[Mapping[str, Any]], world: Mapping[str, Truth], near: float = NEAR
) -> list[str]:
    """Return what of these rows is not so in the world; what is said to be unknown is no lie."""
    found = []
    for row in rows:
        who, real = str(row["id"]), world[str(row["id"])]
        if row["x"] is not None and row["status"] != "UNKNOWN":
            off = max(abs(row["x"] - real.at[0]), abs(row["y"] - real.at[1]))
            if off > near:
                found.append(f"{who} is shown at {row['x']}, {row['y']}, and is at {real.at}")
        if row["status"] == "LOST" and row["why"] != real.why_down:
            found.append(f"{who} is lost: {row['why']!r}; in the world: {real.why_down!r}")
        if real.why_down and row["status"] not in ("LOST", "UNKNOWN", "RECOVERING"):
            found.append(f"{who} is shown {row['status']}; in the world: {real.why_down}")
        if row["status"] in ("LANDED", "FREE", "CHARGING") and not real.landed:
            found.append(f"{who} is shown {row['status']}, and is in the air")
        if row["status"] == "UNKNOWN" and row["x"] is None:
            found.append(f"{who} is said to be nowhere: {row['why']}")
    return found
