"""Plans as a page would send them, sound ones and any others."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile, default_fleet
from pluto_fleet.station.plan.plan import MissionPlan
from tests.library.files.an_app import APP

FLEET = default_fleet(APP)
"""Scouts, which see and measure, and carriers, on a plain of 20 × 20 m."""

Json = dict[str, Any]


def a_plan(
    keep: Path | None = None, fleet: FleetFile = FLEET, now: float = 0.0, app: App = APP
) -> MissionPlan:
    """Return an empty plan, or the one that is kept there; its revisions count from 1."""
    return MissionPlan(app, fleet, keep, now=lambda: now)


def trip(key: str = "trip-one", **given: object) -> Json:
    """Return a trip that can be flown."""
    return {"key": key, "action": "take_photo", "target": [2, 3], **given}


def mission(key: str = "mission-one", *trips: Json, **given: object) -> Json:
    """Return a mission that can be flown."""
    return {"key": key, "name": key, "trips": list(trips or (trip(f"{key}-trip"),)), **given}


def handling(key: str) -> list[Json]:
    """Return the trips that carry an item from one place to another."""
    item = {"name": "box", "mass": 0.004}
    return [
        trip(f"{key}-trip-pick", action="pick_item", target=[3, 4], item=item),
        trip(f"{key}-trip-release", action="release_item", target=[8, 4], item=item),
    ]


def drawn(*missions: Json, fleet: FleetFile = FLEET) -> MissionPlan:
    """Return a plan of these missions."""
    plan = a_plan(fleet=fleet)
    plan.replace(plan.revision, list(missions))
    return plan


def said(plan: MissionPlan) -> list[tuple[str | None, str | None, str | None, str]]:
    """Return what is said of a plan: mission, trip, field, sentence."""
    asyncio.run(plan.examined())
    problems: Any = plan.data()["problems"]
    return [(one["mission"], one["trip"], one["field"], one["text"]) for one in problems]
