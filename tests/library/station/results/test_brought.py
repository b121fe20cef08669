"""What a flight has brought in says of what it is, where, when and of which trip, as its app says or without a word."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.shared.domain.actions import BUILT_IN, Parameter
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.plain_data import value_data
from pluto_fleet.station.feed import Feed
from pluto_fleet.station.results.meaning import REACH, Meanings
from pluto_fleet.station.results.meaning import SIMULATED_UNITS as UNITS

SPRAY = OwnAction(
    name="spray", parameters=(Parameter(name="dose", type=Type.MASS, default=5e-05),), repeat="once"
)


class Sprays:
    """As much of an app as the results ask for."""

    results = ()

    def __init__(self) -> None:
        self.actions = {**BUILT_IN, SPRAY.name: SPRAY}


def trip(event: str = "completed", action: str = "spray", **more: object) -> dict[str, Any]:
    """Return what a trip has done, or what else has become of it."""
    did = {"action": action, "target": [3.0, 4.5, 1.2], "parameters": more.pop("parameters", {})}
    facts = {"mission": "Field", "trip": "A", "round": 0, "attempt": 2, "drone": "cf1"}
    return {"t": 12.5, "event": f"trip.{event}", "result": None, "did": did, **facts, **more}


def taken(*events: dict[str, Any], units: dict[str, str] | None = None) -> Feed:
    """Return what a flight tells after these events."""
    feed = Feed(Sprays(), units or {}, "a-flight")  # type: ignore[arg-type]
    for event in events:
        feed.take(event)
    return feed


def told(action: str, value: object, **parameters: object) -> dict[str, Any]:
    """Return what is told of one trip that has done this."""
    done = trip(action=action, result=value, parameters=parameters)
    [found] = taken(done, units=dict(UNITS)).brought()
    assert isinstance(found, dict)
    return found


def test_a_measurement_says_of_what_it_is_and_where() -> None:
    found = told("measure", 17.3, quantity="pm10")
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
        "drained": None,
    }


def test_what_was_done_beside_its_target_says_where() -> None:
    """A later attempt that was done just there says nothing of it, nor does another trip."""
    beside = trip("beside", target=[3.0, 4.5, 1.2], at=[3.7, 4.5, 1.2])
    done, failed = trip(action="measure", result=1.0), trip("failed", reason="its link was lost")
    feed = taken(beside, done, beside, failed, done, {**done, "trip": "B"})
    found: list[Any] = feed.brought()
    assert [one.get("at") for one in found] == [[3.7, 4.5, 1.2], None, None]
    assert "another drone is at its place" in feed.console()


def on_the_way(value: object, **more: object) -> dict[str, Any]:
    """Return what was brought while a drone flew on, from where it was."""
    facts = {"mission": "Field", "trip": "A", "round": 0, "attempt": 1, "drone": "cf1"}
    result = value_data(value)
    return {
        "t": 5.0,
        "event": "action.result",
        "result": result,
        "at": [1.00049, 2, 1],
        **facts,
    } | more


def test_what_was_brought_on_the_way_is_shown_as_what_an_action_brings_at_the_end_of_it() -> None:
    """Photos among the photos; a hook's own value as it is; and no reserve is charged to any of them."""
    photo = Photo(position=(1.0, 2.0, 1.0), width=1.0, height=1.0, sees=("bloom",), file="1.png")
    feed = taken(
        on_the_way(photo, action="take_photo"),
        on_the_way(21.5, action="measure", parameters={"quantity": "temperature"}),
        on_the_way("smoke"),
        trip(action="take_photo", result=value_data(photo)),
        drained(0.08),
    )
    found: list[Any] = [json.loads(text) for text in feed.results.since(0)]
    assert [one["layers"] for one in found] == [
        ["take_photo:photos", "take_photo:findings"],
        ["measure"],
        [],
        ["take_photo:photos", "take_photo:findings"],
    ]
    assert [one["kind"] for one in found] == ["photo", "measurement", "result", "photo"]
    assert (found[0]["value"]["picture"], found[0]["tags"]) == (
        "/api/photo?result=1&flight=a-flight",
        ["bloom"],
    )
    assert [one["at"] for one in found] == [[1.0, 2, 1]] * 3 + [None]
    assert (found[1]["values"][0]["value"], found[2]["value"]) == (21.5, "smoke")
    assert [one["drained"] for one in found] == [None, None, None, 0.08]


def drained(level: float, drone: str = "cf1") -> dict[str, Any]:
    return {"t": 60.0, "event": "drone.drained", "drone": drone, "level": level}


def test_the_last_trip_before_its_drone_came_home_says_that_its_reserve_was_broken() -> None:
    """No earlier trip does, none of another drone, and none before one that has brought nothing."""
    launched = trip("launched")
    one, other = trip(action="measure", result=1.0), trip(drone="cf2")
    feed = taken(launched, one, launched, one, other, drained(0.08123456), launched, drained(0.1))
    found: list[Any] = feed.brought()
    assert [row["drained"] for row in found] == [None, 0.0812, None]


def test_pages_that_know_a_result_are_told_what_is_known_of_it_since() -> None:
    feed = taken(trip(), drained(0.08))
    assert feed.look(7) and not feed.look(8)
    [again] = map(json.loads, feed.amended_since(6))
    assert again == json.loads(next(feed.results.since(0)))
    assert (again["number"], again["drained"]) == (1, 0.08)
    assert not list(feed.amended_since(7))


def test_what_an_action_of_the_apps_own_returns_is_no_measurement_and_its_dose_a_parameter() -> (
    None
):
    found = told("spray", 5e-05)
    assert (found["kind"], found["action"]) == ("result", "spray")
    assert found["parameters"] == {"dose": 5e-05}
    assert found["values"] == found["layers"] == []
    assert told("spray", True, dose=1e-05)["parameters"] == {"dose": 1e-05}
    assert told("release_item", None)["kind"] == "handling"


def shown(value: object) -> tuple[object, object]:
    """Return what pages get of a result, and what there is to download."""
    feed = taken(trip(result=value_data(value)))
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
        value = value_data(replace(photo, file=file))
        [found] = taken(trip(action="take_photo", result=value)).brought()
        assert isinstance(found, dict)
        told: Any = found["value"]
        assert (found["kind"], told["sees"], told["picture"]) == ("photo", ["bloom"], picture)


OWN = ("weigh", "open_hatch")
DUST = {"action": "measure", "as": "heat", "quantity": "pm10", "unit": "µg/m³", "reach": 2.0}


def meanings(*said: Mapping[str, object]) -> Meanings:
    return Meanings(said, (*BUILT_IN, *OWN), UNITS)


def test_an_app_that_says_nothing_has_the_usual_layers() -> None:
    found = meanings()
    assert [one["id"] for one in found.layers] == [
        "measure",
        "take_photo:photos",
        "take_photo:findings",
    ]
    assert found.layers[0]["reach"] == REACH
    temperature = found.of("measure", "temperature")
    assert (temperature.kind, temperature.unit) == ("measurement", "°C")
    assert found.of("pick_item").kind == found.of("release_item").kind == "handling"
    assert (found.of("weigh").kind, found.of("weigh").layers) == ("result", ())


def test_one_quantity_has_a_layer_of_its_own_and_the_others_keep_theirs() -> None:
    found = meanings(DUST)
    assert [one["id"] for one in found.layers][:2] == ["measure:pm10", "measure"]
    assert found.of("measure", "pm10").layers == ("measure:pm10",)
    assert found.of("measure", "radon").layers == ("measure",)
    assert found.of("measure", "radon").unit is None


def test_what_an_app_says_of_photos_is_all_of_it() -> None:
    found = meanings({"action": "take_photo", "as": "photos", "label": "The site"})
    assert found.of("take_photo").layers == ("take_photo:photos",)
    assert found.of("take_photo").finds is None


@pytest.mark.parametrize(
    ("kind", "unit", "value", "shown"),
    [
        ("mass", "mg", 5e-05, (50.0, "mg")),
        ("mass", None, 0.25, (0.25, "kg")),
        ("temperature", "C", 294.15, (21.0, "C")),
        ("percent", None, 0.4, (40.0, "%")),
        ("speed", "km/h", 10.0, (36.0, "km/h")),
    ],
)
def test_a_quantity_is_shown_in_its_unit(
    kind: str, unit: str | None, value: float, shown: tuple[float, str]
) -> None:
    said = {"action": "weigh", "as": "values", "type": kind} | ({"unit": unit} if unit else {})
    number = meanings(said).of("weigh").number(value)
    assert number == {"quantity": "weigh", "value": shown[0], "unit": shown[1]}


@pytest.mark.parametrize("value", [None, True, "3", float("nan"), float("inf"), 10**400, [1.0]])
def test_what_is_no_finite_number_is_none(value: object) -> None:
    assert meanings(DUST).of("measure", "pm10").number(value) is None
