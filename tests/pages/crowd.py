"""Fifty drones on a field, and two hundred missions that want them: as in the flight whose cost is measured."""

from __future__ import annotations

from typing import Any

from tests.kit.station import Station, Stations
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


def crowded_station(stations: Stations) -> Station:
    """Return the station of an app with that fleet."""
    station = stations.fresh("drugs_distribution", "--speed", "2")
    many = fleet(DRONES).replace(f"[{SIDE}, {SIDE}]", f"[{SIDE}, {DEPTH}]")
    station.app.fleet.write_text(many, encoding="utf-8")
    return station


def crowd(station: Station) -> None:
    """Give it that plan, which nothing has started yet."""
    problems = station.plan([near(mission) for mission in plan(MISSIONS)])
    assert problems == []
