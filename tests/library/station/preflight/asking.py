"""Starts to be forecast, of an app with scouts, which take photos, and carriers, which lift items."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.fleet import DroneEntry, FleetFile, default_fleet
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.station.preflight import preflight
from pluto_fleet.station.preflight.preflight import Preflight
from pluto_fleet.station.preflight.question import Present, Question
from pluto_fleet.station.rows import words
from pluto_fleet.station.wire import Forecast, Words
from tests.library.files.an_app import APP
from tests.library.station.in_process import in_this_process
from tests.library.station.plan.drawing import Json, drawn, mission, trip

FLEET = default_fleet(APP, 4)
"""Two scouts and two carriers, on a plain of 20 × 20 m, kept apart."""
SCOUTS = tuple(one for one in FLEET.drones if one.category == "scout")


def photos(key: str, number: int) -> Json:
    """Return a mission of so many photos, far apart."""
    trips = [trip(f"{key}-trip-{i}", target=[4 + 5 * (i % 3), 6 + i % 7]) for i in range(number)]
    return mission(key, *trips)


THREE = (photos("mission-one", 2), photos("mission-two", 3), photos("mission-six", 1))


def question(
    *missions: Json,
    drones: Sequence[DroneEntry] = FLEET.drones,
    level: float = 1.0,
    out: Sequence[str] = (),
    fleet: FleetFile = FLEET,
    faults: Faults | None = None,
    runs: int | None = 7,
) -> Question:
    """Return the question of a Start of these missions, with all batteries at one level."""
    fleet = replace(fleet, drones=tuple(drones))
    return Question(
        app=moving(APP, fleet.motion, charges=fleet.charges_at_home),
        fleet=fleet,
        missions=drawn(*missions, fleet=fleet).launchable()[0],
        present=present(fleet, level, out),
        faults=faults or Faults(),
        runs=runs,
    )


def present(fleet: FleetFile, level: float, out: Sequence[str] = ()) -> list[Present]:
    """Return the drones in their docks, with one level of battery; those that are `out` are lost."""
    lost = words("preflight.lost", "lost")
    return [
        Present(id=one.id, at=one.home, battery=level, out=lost if one.id in out else None)
        for one in fleet.drones
    ]


def answer(asked: Question, folder: Path) -> Forecast:
    """Return the forecast of a question."""
    keys = [one.name for one in asked.missions]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(preflight, "in_a_copy", in_this_process)
        return asyncio.run(Preflight(folder).ask(asked, keys, []))


def texts(said: Sequence[Words]) -> list[str]:
    return [one["text"] for one in said]


def of(forecast: Forecast, key: str) -> Any:
    """Return what is forecast of one mission, by its key."""
    return next(one for one in forecast["missions"] if one["key"] == key)
