"""Fifty drones on a field, and two hundred missions that want them: as in the flight whose cost is measured."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from tests.kit.station import App, Station
from watching.flight import SIDE, fleet, plan

DRONES, MISSIONS = 50, 200
DEPTH = 30.0
"""Metres of the field, away from the homes: an eighth of an hour of flight is enough for it."""


def near(mission: dict[str, Any]) -> dict[str, Any]:
    """Return a mission whose places are within reach of a battery."""
    trips = [
        {**trip, "target": [trip["target"][0], trip["target"][1] * DEPTH / SIDE]}
        for trip in mission["trips"]
    ]
    return {**mission, "trips": trips}


@contextmanager
def crowded_station(app: App, folder: Path) -> Iterator[Station]:
    """Serve an app with that fleet, and that plan, which nothing has started yet."""
    many = folder / "fleet.toml"
    many.write_text(fleet(DRONES).replace(f"[{SIDE}, {SIDE}]", f"[{SIDE}, {DEPTH}]"))
    station = Station(
        app=replace(app, fleet=many), folder=folder / "station", options=("--speed", "2")
    )
    station.folder.mkdir()
    station.start()
    try:
        revision = station.get("/api/plan")["revision"]
        missions = [near(mission) for mission in plan(MISSIONS)]
        status, answer = station.put("/api/plan", {"revision": revision, "missions": missions})
        assert (status, answer["problems"]) == (200, []), answer
        yield station
    finally:
        station.end()
