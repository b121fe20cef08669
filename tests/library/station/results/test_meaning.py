"""What results are without a word of the app, and what an app may say of them."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.station.results.meaning import REACH, SIMULATED_UNITS, Meanings

OWN = ("weigh", "open_hatch")
DUST = {"action": "measure", "as": "heat", "quantity": "pm10", "unit": "µg/m³", "reach": 2.0}


def meanings(*said: Mapping[str, object]) -> Meanings:
    return Meanings(said, (*BUILT_IN, *OWN), SIMULATED_UNITS)


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
