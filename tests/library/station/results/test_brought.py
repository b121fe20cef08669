"""What a flight has brought in says of what it is, in which unit, where, when, and of which trip."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

from pluto_fleet.shared.domain.actions import BUILT_IN, Parameter
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.plain_data import value_data
from pluto_fleet.station.feed import Feed
from pluto_fleet.station.results.meaning import SIMULATED_UNITS as UNITS

SPRAY = OwnAction(
    name="spray", parameters=(Parameter(name="dose", type=Type.MASS, default=5e-05),), repeat="once"
)


class Sprays:
    """As much of an app as the results ask for."""

    results = ()

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
        "action": "measure",
        "parameters": {},
        "target": [3.0, 4.5, 1.2],
        "at": None,
        "place": None,
        "value": 17.3,
        "values": [{"quantity": "pm10", "value": 17.3, "unit": "µg/m³"}],
        "tags": [],
        "layers": ["measure"],
    }


def test_what_was_done_beside_its_target_says_where() -> None:
    """A later attempt that was done just there says nothing of it, nor does another trip."""
    feed = Feed(Sprays(), {})  # type: ignore[arg-type]
    facts = {"t": 1.0, "mission": "Field", "trip": "A", "round": 0, "attempt": 1, "drone": "cf1"}
    did = {"action": "measure", "target": [3.0, 4.5, 1.2], "parameters": {}}
    beside = {"event": "trip.beside", "target": did["target"], "at": [3.7, 4.5, 1.2], **facts}
    done = {"event": "trip.completed", "result": 1.0, "did": did, **facts}
    failed = {"event": "trip.failed", "reason": "its link was lost", **facts}
    for event in (beside, done, beside, failed, done, {**done, "trip": "B"}):
        feed.take(event)
    found: list[Any] = feed.brought()
    assert [one.get("at") for one in found] == [[3.7, 4.5, 1.2], None, None]
    assert "another drone is at its place" in feed.console()


def test_what_an_action_of_the_apps_own_returns_is_no_measurement_and_its_dose_a_parameter() -> (
    None
):
    found = told("spray", 5e-05, dict(UNITS))
    assert (found["kind"], found["action"]) == ("result", "spray")
    assert found["parameters"] == {"dose": 5e-05}
    assert found["values"] == found["layers"] == []
    assert told("spray", True, {}, dose=1e-05)["parameters"] == {"dose": 1e-05}
    assert told("release_item", None, {})["kind"] == "handling"


def shown(value: object, action: str = "spray") -> tuple[object, object]:
    """Return what pages get of a result, and what there is to download."""
    feed = Feed(Sprays(), {})  # type: ignore[arg-type]
    did = {"action": action, "target": [3.0, 4.5, 1.2], "parameters": {}}
    event = {"t": 1.0, "event": "trip.completed", "mission": "Field", "trip": "A", "drone": "cf1"}
    feed.take({**event, "result": value_data(value), "did": did})
    [page], [found] = feed.results.since(0), feed.brought()
    assert isinstance(found, dict)
    return json.loads(page)["value"], found["value"]


def test_what_an_action_returned_is_downloaded_as_it_is_and_shown_in_words() -> None:
    photo = Photo(position=(1.0, 2.0, 1.0), width=1.0, height=1.0, sees=("bloom",))
    value = {"Blüte": (1, 2.5, float("nan")), "seen": [photo, {1}], "none": None}
    page, downloaded = shown(value)
    assert isinstance(downloaded, dict)
    [seen, text] = downloaded["seen"]
    assert downloaded == {"Blüte": [1, 2.5, "nan"], "seen": [seen, text], "none": None}
    assert (seen["sees"], text) == (["bloom"], "{1}")
    assert str(page).startswith('{"Blüte": [1, 2.5, "nan"], "seen": [{"position": [1.0, 2.0, 1.0],')
    assert shown(()) == ("[]", [])
    assert shown("yes") == ("yes", "yes")
    assert shown(3) == (3, 3)
    assert shown(123_456_789) == ("123456789", 123_456_789)


def test_a_photo_has_an_address_where_its_camera_has_left_a_picture() -> None:
    photo = Photo(position=(1.0, 2.0, 1.0), width=1.0, height=1.0, sees=("bloom",))
    address = "/api/photo?result=1&flight=a-flight"
    for file, picture in ((None, None), ("w1-1.png", address)):
        feed = Feed(Sprays(), {}, "a-flight")  # type: ignore[arg-type]
        did = {"action": "take_photo", "target": [1.0, 2.0, 1.0], "parameters": {}}
        event = {"t": 1.0, "event": "trip.completed", "mission": "F", "trip": "A", "drone": "cf1"}
        feed.take({**event, "result": value_data(replace(photo, file=file)), "did": did})
        [found] = feed.brought()
        assert isinstance(found, dict)
        value: Any = found["value"]
        assert (found["kind"], value["sees"], value["picture"]) == ("photo", ["bloom"], picture)
