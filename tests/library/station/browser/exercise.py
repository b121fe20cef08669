"""The thesis's second exercise (6.2.1): three missions, and where their trips go on the ward."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from tests.kit.station import Station

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Trip:
    """One trip of the exercise."""

    action: str
    at: Place
    item: str = ""


PLAN: dict[str, list[Trip]] = {
    "Mission 1": [
        Trip("take_photo", (3.0, 8.5)),
        Trip("take_photo", (9.0, 8.5)),
        Trip("take_photo", (15.0, 8.5)),
    ],
    "Mission 2": [Trip("measure", (9.0, 1.5)), Trip("measure", (15.0, 1.5))],
    "Mission 3": [
        Trip("pick_item", (2.5, 3.0), "pills"),
        Trip("release_item", (16.0, 2.5), "pills"),
        Trip("take_photo", (14.0, 2.5)),
        Trip("measure", (14.0, 1.0)),
    ],
}
"""Where they go "was not important while testing": these are beds, and the pharmacy."""

COMPLETED = dict.fromkeys(PLAN, "COMPLETED")

DONE = {("pick_item", "Mission 3/1/0"): 1, ("release_item", "Mission 3/2/0"): 1}
"""What the simulated world has seen of it that must not be done twice; trips are named by number."""


def put_in(station: Station) -> Station:
    """Give a station the whole plan, behind the page's back; return it."""
    assert station.plan([mission(n, name) for n, name in enumerate(PLAN)]) == []
    return station


def mission(number: int, name: str) -> dict[str, Any]:
    """Return a mission of the plan as a page would send it."""
    trips = [
        {
            "key": f"trip-{number}-{index}",
            "action": trip.action,
            "target": list(trip.at),
            "parameters": {},
            "item": {"name": trip.item, "mass": "8 g"} if trip.item else None,
        }
        for index, trip in enumerate(PLAN[name])
    ]
    return {"key": f"mission-{number}", "name": name, "trips": trips}


def names(station: Station) -> list[str]:
    """Return what the missions of a station's plan are called."""
    return [one["name"] for one in station.missions]


def targets(station: Station) -> list[list[tuple[float, ...]]]:
    """Return where the trips of each mission go."""
    return [[tuple(trip["target"][:2]) for trip in one["trips"]] for one in station.missions]
