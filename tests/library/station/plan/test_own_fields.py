"""Fields of an app's own as pages learn of them, and as they fly; sessions/own_fields.txt has the rest."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.station.config import StationConfig, described
from pluto_fleet.station.map.drawn import DrawnMap
from pluto_fleet.station.plan.plan import MissionPlan
from tests.library.files.an_app import OWN
from tests.library.station.plan.drawing import mission, said, trip

FLEET = default_fleet(OWN)
TRIP = {"action": "measure", "fragile": False, "warmth": "21 C"}


def test_a_page_learns_of_them_with_their_types_and_units(tmp_path: Path) -> None:
    config = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    fields: Any = described(OWN, config, DrawnMap(FLEET.airspace, config.map_path), "x")["fields"]
    by_name = {one["name"]: one for on in ("mission", "trip") for one in fields[on]}
    assert by_name["patient"] == {
        "name": "patient",
        "type": "text",
        "label": "Patient",
        "default": None,
        "own": True,
        "needed": True,
        "units": [],
    }
    assert by_name["margin"]["units"] == ["ms", "s", "min", "h"]
    assert (by_name["margin"]["default"], by_name["margin"]["needed"]) == (600.0, False)
    assert by_name["delay"] == {"name": "delay", "type": "time", "label": "delay", "default": None}
    json.dumps(fields)


def test_a_value_of_each_type_can_be_typed() -> None:
    """As a person writes it; it is launched in SI units."""
    typed = {"patient": "Ada", "margin": "3 min", "share": "40 %", "urgent": True}
    plan = MissionPlan(OWN, FLEET, None)
    plan.replace(plan.revision, [mission("mission-one", trip("trip-one-1", **TRIP), **typed)])
    assert said(plan) == []
    (made,), _ = plan.launchable()
    ready: Any = made
    assert (ready.patient, ready.margin, ready.share, ready.urgent) == ("Ada", 180.0, 0.4, True)
    (flown,) = ready.trips
    assert (flown.fragile, flown.warmth, flown.layers, flown.note) == (False, 294.15, 1, "")
