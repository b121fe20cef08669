"""The formulas of heat map and mosaic give what vectors.json says, which the pages' own must give as well."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.station.results.heat import heat_at, newest
from pluto_fleet.station.results.mosaic import on_top, stacked

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
