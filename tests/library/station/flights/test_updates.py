"""What all pages see goes on, though something of it cannot be shown."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

from pluto_fleet.station.attention.attention import Attention
from pluto_fleet.station.map.drawn import DrawnMap
from pluto_fleet.station.plan.plan import MissionPlan
from pluto_fleet.station.updates import Updates
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET


class Unseen:
    """A flight that cannot be looked at."""

    id, journal, trouble = "a.journal", "a.journal", ""
    lives, life, end, records, now = False, None, None, None, 0.0

    def look(self, number: int) -> bool:
        """Be a mistake of ours."""
        raise ZeroDivisionError


class Nothing:
    """What is known of the drones where none has flown yet."""

    def rows(self) -> tuple[()]:
        """Return that there is nothing to see."""
        return ()

    def causes(self, drones: object) -> tuple[()]:
        """Return that there is nothing to know of."""
        return ()


class Shown:
    """A station with such a flight."""

    def __init__(self) -> None:
        self.described: Any = {"server": "x"}
        self.session: Any = Unseen()
        self.fleet = FLEET
        self.plan = MissionPlan(APP, FLEET, None)
        self.map = DrawnMap(FLEET.airspace, Path("nowhere.toml"))
        self.history: Any = Nothing()
        self.map_revision = 0
        self.fleet = FLEET
        self.attention = Attention(Path("nowhere"), lambda: 0.0)


def test_a_mistake_in_what_is_shown_leaves_no_one_waiting_nor_who_heard_of_the_drones() -> None:
    complaints: list[object] = []

    async def scenario() -> dict[str, Any]:
        asyncio.get_running_loop().set_exception_handler(lambda _, about: complaints.append(about))
        shown = Shown()
        scene = Updates(shown)
        waiting = asyncio.ensure_future(scene.newer("", 0, 0, 0))
        await asyncio.sleep(0)
        scene.hurry()
        async with asyncio.timeout(60):
            await asyncio.sleep(0)
            shown.session = None
            told: dict[str, Any] = json.loads(await waiting)
        return told

    assert asyncio.run(scenario())["state"]["phase"] == "idle"
    assert len(complaints) == 1
