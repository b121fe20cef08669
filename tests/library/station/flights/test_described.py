"""What a station answers while missions fly is what its description says."""

from __future__ import annotations

import json
from typing import Any

from jsonschema import Draft202012Validator

from pluto_fleet.station.web.reads import DESCRIPTION
from tests.kit.station import until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import comes_to, tell

DESCRIBED = json.loads(DESCRIPTION.read_text(encoding="utf-8"))


def holds(answer: Any, name: str) -> None:
    """Hold an answer to a type of the description."""
    schema = {**DESCRIBED, "$ref": f"#/components/schemas/{name}"}
    Draft202012Validator(schema).validate(answer)


def test_a_flight_is_told_as_it_is_described(serve: Serve) -> None:
    station = serve("alfalfa", "--speed", "30")
    holds(station.get("/api/app"), "AppData")
    holds(station.get("/api/plan"), "PlanData")
    holds(station.now(), "LiveMessage")
    tell(station, "start")
    until(lambda: len(station.now()["results"]) > 3, "some results are there")
    flying = station.now()
    assert flying["log"] and flying["drones"]
    holds(flying, "LiveMessage")
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    holds(station.now(), "LiveMessage")
    holds(station.get("/api/plan"), "PlanData")
