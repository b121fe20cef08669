"""Maps in degrees: held to PROJ by `python -m tests.geodesy`, here at some places, and at the odd ones."""

from __future__ import annotations

import json
from math import dist, pi
from pathlib import Path

import pytest

from pluto_fleet.geodesy import REACH, LocalPlane
from tests.geodesy import ENOUGH, judged

MILAN = LocalPlane(45.4642, 9.19, altitude=120.0, bearing=pi / 6)


def test_places_are_where_proj_says() -> None:
    found = [judged(number) for number in range(200)]
    assert max(one.off for one in found) <= ENOUGH
    assert max(one.back for one in found) <= ENOUGH
    assert max(one.bent for one in found if one.far <= 2000.0) <= 0.05


def test_the_bearing_is_the_compass_direction_of_y() -> None:
    towards_east = LocalPlane(0.0, 0.0, bearing=pi / 2)
    latitude, longitude, _ = towards_east.to_degrees((0.0, 1000.0, 0.0))
    assert latitude == pytest.approx(0.0, abs=1e-9)
    assert longitude == pytest.approx(1000 / 6_378_137 * 180 / pi, abs=1e-8)


def test_what_keeps_its_height_keeps_its_altitude_and_what_climbs_stays_above_its_place() -> None:
    low = MILAN.to_degrees((8000.0, -6000.0, 2.0))
    high = MILAN.to_degrees((8000.0, -6000.0, 90.0))
    assert (low[2], high[2]) == (122.0, 210.0)
    assert low[:2] == high[:2]


@pytest.mark.parametrize("longitude", [180.0, -180.0])
@pytest.mark.parametrize("latitude", [-90.0, 0.0, 89.9999, 90.0])
def test_there_is_no_edge_of_the_world(latitude: float, longitude: float) -> None:
    plane = LocalPlane(latitude, longitude)
    for place in [(0.0, 0.0, 0.0), (500.0, 500.0, 10.0), (-500.0, 20.0, 10.0)]:
        there = plane.to_degrees(place)
        assert -90 <= there[0] <= 90
        assert -180 <= there[1] <= 180
        assert dist(plane.to_metres(there), place) <= ENOUGH


def test_what_is_beyond_a_map_is_refused_with_how_far_it_is() -> None:
    with pytest.raises(ValueError, match="is 25 km from the map's origin: a map reaches 20 km"):
        MILAN.to_degrees((25_000.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="is 477 km from the map's origin"):
        MILAN.to_metres((41.9, 12.5, 20.0))
    with pytest.raises(ValueError, match="from the map's origin"):  # on the other side of the Earth
        MILAN.to_metres((-45.4642, -170.81, 120.0))
    with pytest.raises(ValueError, match="out of reach"):
        MILAN.to_metres((float("nan"), 9.19, 120.0))
    assert MILAN.to_degrees((REACH, 0.0, 0.0))


def test_the_pages_are_held_to_what_is_computed_here() -> None:
    """`earth.test.js` reads the same examples."""
    examples = json.loads((Path(__file__).parent / "station" / "map" / "earth.json").read_text())
    for one in examples:
        found = LocalPlane(**one["plane"]).to_degrees((*one["place"], 0.0))
        assert found[:2] == pytest.approx(one["degrees"], abs=1e-9)
