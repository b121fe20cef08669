"""What a flight has brought in says of what it is, in which unit, where, when, and of which trip."""

from __future__ import annotations

from typing import Any

from plutoc_runtime.actions import BUILT_IN, Action, Parameter
from plutoc_runtime.quantities import Type
from plutoc_runtime.simulation.world import UNITS
from plutoc_runtime.station.feed import Feed
from tests.station.browser.serving import Station, until
from tests.station.flights.conftest import Serve
from tests.station.flights.test_flights import comes_to, tell

SPRAY = Action(
    name="spray", parameters=(Parameter(name="dose", type=Type.MASS, default=5e-05),), repeat="once"
)


class Sprays:
    """As much of an app as the results ask for."""

    def __init__(self) -> None:
        self.actions = {**BUILT_IN, SPRAY.name: SPRAY}


def told(action: str, value: object, units: dict[str, str], **parameters: object) -> dict[str, Any]:
    """Return what is told of one trip that has done this."""
    feed = Feed(Sprays(), units)  # type: ignore[arg-type]
    facts = {"mission": "Field", "trip": "A", "round": 0, "attempt": 2, "drone": "cf1"}
    did = {"action": action, "target": [3.0, 4.5, 1.2], "parameters": parameters}
    feed.take({"t": 12.5, "event": "trip.completed", **facts, "result": value, "did": did})
    [found] = feed.brought()
    assert isinstance(found, dict)
    return found


def test_a_measurement_says_of_what_it_is_and_where() -> None:
    found = told("measure", 17.3, dict(UNITS), quantity="pm10")
    assert found == {
        "number": 1,
        "time": 12.5,
        "mission": "Field",
        "trip": "A",
        "round": 0,
        "attempt": 2,
        "drone": "cf1",
        "kind": "measurement",
        "value": 17.3,
        "action": "measure",
        "target": [3.0, 4.5, 1.2],
        "parameters": {},
        "quantity": "pm10",
        "unit": "µg/m³",
    }


def test_a_quantity_that_was_not_named_is_the_usual_one() -> None:
    found = told("measure", 21.0, dict(UNITS))
    assert (found["quantity"], found["unit"]) == ("temperature", "°C")


def test_a_unit_that_nobody_has_declared_is_not_made_up() -> None:
    """What a real drone's sensor gives has the unit of its sensor, which nobody knows here."""
    assert told("measure", 21.0, {})["unit"] is None
    assert told("measure", 3.0, dict(UNITS), quantity="radon")["unit"] is None


def test_what_an_action_of_the_apps_own_returns_is_no_measurement_and_its_dose_a_parameter() -> (
    None
):
    found = told("spray", 5e-05, dict(UNITS))
    assert (found["kind"], found["action"]) == ("result", "spray")
    assert found["parameters"] == {"dose": 5e-05}
    assert (found["quantity"], found["unit"]) == (None, None)
    assert told("spray", True, {}, dose=1e-05)["parameters"] == {"dose": 1e-05}
    assert told("release_item", None, {})["kind"] == "result"


def test_the_same_is_told_of_a_flight_as_it_flies_and_by_the_next_station(serve: Serve) -> None:
    """Of trips that hooks have added, too."""
    station = serve("alfalfa", "--speed", "30")
    tell(station, "start")
    until(lambda: "pollinate" in actions(station), "something is pollinated")
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    results = station.get("/api/results.json")
    photos = [one for one in results if one.get("action") == "take_photo"]
    assert all(one["kind"] == "photo" and len(one["target"]) == 3 for one in photos)
    [dose, *_] = [one for one in results if one.get("action") == "pollinate"]
    assert (dose["kind"], dose["parameters"]) == ("result", {"dose": 2e-05})
    station.kill()
    station.start()
    assert station.get("/api/results.json") == results


def actions(station: Station) -> set[str]:
    return {str(one.get("action")) for one in station.get("/api/results.json")}
