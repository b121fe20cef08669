"""What the layers of the map show is what the simulated world held, at a hundred random places."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import layers
from pluto_fleet.station.results.flights import Brought, FlightResults, ResultsOfFlights
from pluto_fleet.station.results.heat import Sample, heat_at, newest
from pluto_fleet.station.results.mosaic import on_top
from tests.kit.apps import example
from tests.library.station import in_process

SEED = 3


PLACES = 100
ERROR = 0.006
"""The largest error of a simulated sensor, as a share: six times its standard deviation."""


@dataclass(frozen=True, kw_only=True)
class Flown:
    """A flight that is over."""

    app: App
    world: World
    """The world without the errors of its sensors: `truth` of them."""
    size: tuple[float, float]
    results: FlightResults


def flown(name: str, folder: Path) -> Flown:
    """Fly an example's missions to their end, and read their results off the journal."""
    with pytest.MonkeyPatch.context() as patch, in_process.world(patch) as here:
        options = {"seed": SEED, "speed": 200.0}
        station = in_process.Flown(world=here, name=name, folder=folder, options=options)
        station.tell("start")
        station.comes_to("over")
        [journal] = station.journals()
    app, fleet = example(name).app, example(name).fleet
    return Flown(
        app=app,
        world=World(SEED, fleet.airspace, fleet.world),
        size=fleet.airspace.size,
        results=ResultsOfFlights(app, folder).of(journal.stem),
    )


def truth(world: World, quantity: str, x: float, y: float) -> float:
    """Return what the world holds at a place, without the error of a sensor."""
    value = world.background.get(quantity, 0.0)
    for source in world.sources:
        if source.quantity == quantity:
            value += source.at_distance(x - source.at[0], y - source.at[1])
    return value


@pytest.fixture(scope="module")
def flights(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Flown]:
    """Fly an example once: the dust of a building site, an archaeological site, a field of alfalfa."""
    return cache(lambda name: flown(name, tmp_path_factory.mktemp(name)))


Flights = Callable[[str], Flown]
SITE, FIELD = "aerial_mapping", "alfalfa"


def places(flight: Flown) -> list[tuple[float, float]]:
    """Return random places of the map."""
    chance, (width, depth) = Random(7), flight.size
    return [(chance.uniform(0, width), chance.uniform(0, depth)) for _ in range(PLACES)]


def where(one: Brought) -> tuple[float, float]:
    """Return where something was really done."""
    point = one.result["at"] or one.result["target"]
    assert point is not None
    return point[0], point[1]


def of_layer(flight: Flown, layer: str) -> list[Brought]:
    """Return the results that a layer shows."""
    return [one for one in flight.results.rows if layer in one.result["layers"]]


def test_dust_is_shown_as_it_was_where_it_was_measured_and_between(flights: Flights) -> None:
    pm10 = flights("pm10")
    [layer] = layers(pm10.app, sim=True)[:1]
    assert (layer["kind"], layer["quantity"], layer["unit"]) == ("heat", "pm10", "µg/m³")
    assert layer["reach"] is not None
    shown: list[Sample] = []
    held: list[Sample] = []
    for one in of_layer(pm10, layer["id"]):
        [number] = one.result["values"]
        assert (number["quantity"], number["unit"]) == ("pm10", "µg/m³")
        shown.append((*where(one), number["value"]))
        held.append((*where(one), truth(pm10.world, "pm10", *where(one))))
    shown, held = newest(shown), newest(held)
    assert len(shown) > 20
    for (x, y, value), (_, _, real) in zip(shown, held, strict=True):
        assert heat_at(shown, x, y, layer["reach"]) == value == pytest.approx(real, rel=ERROR)
    known = 0
    for x, y in places(pm10):
        here = heat_at(shown, x, y, layer["reach"])
        near = any((x - sx) ** 2 + (y - sy) ** 2 < layer["reach"] ** 2 for sx, sy, _ in shown)
        assert (here is not None) == near
        if here is not None:
            known += 1
            assert here == pytest.approx(heat_at(held, x, y, layer["reach"]), rel=ERROR)
    assert 0 < known < PLACES


@pytest.mark.parametrize("name", [SITE, FIELD])
def test_photos_show_what_lies_there_and_the_best_one_is_on_top(
    name: str, flights: Flights
) -> None:
    flight = flights(name)
    photos = of_layer(flight, "take_photo:photos")
    assert len(photos) > 10
    for one in photos:
        assert one.value["sees"] == lying_on(flight, one.value)
    covered = 0
    for x, y in places(flight):
        there = [one for one in photos if is_on(one.value, x, y)]
        shown = on_top([(one.result["number"], one.value) for one in photos], x, y)
        assert (shown is not None) == bool(there)
        if shown is not None:
            covered += 1
            best = max(one.value["sharpness"] for one in there)
            sharp = [one.result["number"] for one in there if one.value["sharpness"] == best]
            assert shown == max(sharp)
    assert 0 < covered < PLACES


def lying_on(flight: Flown, photo: dict[str, Any]) -> list[str]:
    """Return the kinds of all that lies on the ground of a photo, by the world's own data."""
    return sorted(one.kind for one in flight.world.features if is_on(photo, *one.at))


def is_on(photo: dict[str, Any], x: float, y: float) -> bool:
    """Return whether a place is on the ground that a photo shows."""
    (px, py, _), width, height = photo["position"], photo["width"], photo["height"]
    return bool(px - width / 2 <= x <= px + width / 2 and py - height / 2 <= y <= py + height / 2)


def test_findings_are_those_of_the_app_alone(flights: Flights) -> None:
    field, site = flights(FIELD), flights(SITE)
    found = [tag for one in of_layer(field, "take_photo:findings") for tag in one.result["tags"]]
    kinds = {one.kind for one in field.world.features}
    assert found
    assert {*found} <= kinds
    assert not any(one.result["tags"] for one in site.results.rows)  # it shows photos only
    assert "take_photo:findings" not in [one["id"] for one in layers(site.app, sim=True)]


def test_there_is_nothing_of_flights_that_are_not_there(flights: Flights) -> None:
    pm10 = flights("pm10")
    kept = ResultsOfFlights(pm10.app, pm10.results.journal.parent)
    for name in ("", ".", "..", "../flight", "flight.journal", "flight\0", "*"):
        with pytest.raises(BadInput, match="there is no flight"):
            kept.of(name)
