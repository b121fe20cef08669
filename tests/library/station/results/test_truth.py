"""What a layer of the map shows is what the simulated world held.

The formulas of heat map and mosaic give what vectors.json says, which the pages' own must give as well.
"""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from pluto_fleet.shared.alone.world import World
from pluto_fleet.station.config import layers
from pluto_fleet.station.results.flights import ResultsOfFlights
from tests.kit.apps import example
from tests.library.station.conftest import Serve
from tests.library.station.results.heat import Sample, heat_at, newest
from tests.library.station.results.mosaic import on_top, stacked

SEED = 3
PLACES = 100
ERROR = 0.006
"""The largest error of a simulated sensor, as a share: six times its standard deviation."""


def truth(world: World, x: float, y: float) -> float:
    """Return the dust at a place, without the error of a sensor."""
    dust = [source for source in world.sources if source.quantity == "pm10"]
    here = sum(source.at_distance(x - source.at[0], y - source.at[1]) for source in dust)
    return world.background.get("pm10", 0.0) + here


def test_dust_is_shown_as_it_was_where_it_was_measured_and_between(serve: Serve) -> None:
    station, pm10 = serve("pm10", seed=SEED, speed=200.0), example("pm10")
    station.tell("start")
    station.comes_to("over")
    [journal] = station.journals()
    space = pm10.fleet.airspace
    world = World(SEED, space, pm10.fleet.world)
    [layer] = layers(pm10.app, sim=True)[:1]
    assert (layer["kind"], layer["quantity"], layer["unit"]) == ("heat", "pm10", "µg/m³")
    assert layer["reach"] is not None
    shown: list[Sample] = []
    held: list[Sample] = []
    for row in ResultsOfFlights(pm10.app, station.folder).of(journal.stem).rows:
        if layer["id"] not in row.result["layers"]:
            continue
        point = row.result["at"] or row.result["target"]
        assert point is not None
        [number], (x, y, *_) = row.result["values"], point
        assert (number["quantity"], number["unit"]) == ("pm10", "µg/m³")
        shown.append((x, y, number["value"]))
        held.append((x, y, truth(world, x, y)))
    shown, held = newest(shown), newest(held)
    assert len(shown) > 20
    for (x, y, value), (_, _, real) in zip(shown, held, strict=True):
        assert heat_at(shown, x, y, layer["reach"]) == value == pytest.approx(real, rel=ERROR)
    known, chance = 0, Random(7)
    for _ in range(PLACES):
        x, y = (chance.uniform(0, side) for side in space.size)
        here = heat_at(shown, x, y, layer["reach"])
        near = any((x - sx) ** 2 + (y - sy) ** 2 < layer["reach"] ** 2 for sx, sy, _ in shown)
        assert (here is not None) == near
        if here is not None:
            known += 1
            assert here == pytest.approx(heat_at(held, x, y, layer["reach"]), rel=ERROR)
    assert 0 < known < PLACES


VECTORS: dict[str, list[dict[str, Any]]] = json.loads(
    (Path(__file__).parent / "vectors.json").read_text(encoding="utf-8")
)


@pytest.mark.parametrize("vector", VECTORS["heat"], ids=lambda one: one["what"])
def test_heat(vector: dict[str, Any]) -> None:
    samples = [(x, y, value) for x, y, value in vector["samples"]]
    x, y = vector["at"]
    found = heat_at(samples, x, y, vector["reach"])
    assert found == (None if vector["value"] is None else pytest.approx(vector["value"], rel=1e-9))


@pytest.mark.parametrize("vector", VECTORS["newest"])
def test_the_newest_of_a_place_counts(vector: dict[str, Any]) -> None:
    assert [list(one) for one in newest(map(tuple, vector["samples"]))] == vector["kept"]


@pytest.mark.parametrize("vector", VECTORS["mosaic"], ids=lambda one: one["what"])
def test_mosaic(vector: dict[str, Any]) -> None:
    shots = [(one["number"], one) for one in vector["photos"]]
    assert on_top(shots, *vector["at"]) == vector["on_top"]
    drawn = [number for number, _ in stacked(shots)]
    assert sorted(drawn) == sorted(number for number, _ in shots)
    if vector["on_top"] is not None:
        later = drawn[drawn.index(vector["on_top"]) + 1 :]
        others = [(number, one) for number, one in shots if number in later]
        assert on_top(others, *vector["at"]) is None
