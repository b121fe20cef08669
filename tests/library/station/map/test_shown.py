"""A change of the map reaches every page."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.station import Station
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET, a_plan


def test_all_pages_learn_of_a_new_map(tmp_path: Path) -> None:
    """By its revision in what they are told; its names are known to plans that are taken in."""
    config = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    config.own_folder.mkdir()
    station = Station(APP, config, a_plan())
    station.begin()

    async def scene() -> list[int]:
        first = json.loads(await station.newer("", 0, 0, 0))
        place = {"name": "Desk", "x": 1, "y": 2}
        await station.map.change(station.map.revision, {"places": [place]})
        second = json.loads(await station.newer("", first["version"], 0, 0))
        return [first["state"]["map"], second["state"]["map"]]

    before, after = asyncio.run(scene())
    assert after == before + 1
    assert station.plan.landmarks.place == {"Desk": (1.0, 2.0)}
    assert Station(APP, config, a_plan()).plan.landmarks == station.plan.landmarks
