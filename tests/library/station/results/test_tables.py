"""A table of results is read by spreadsheets as what it is, whatever texts a flight has brought."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from itertools import pairwise
from math import pi
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.hooks.plain_data import value_data
from pluto_fleet.station.results.flights import Brought, FlightResults
from pluto_fleet.station.results.meaning import Meanings
from pluto_fleet.station.results.rows import ResultRows
from pluto_fleet.station.results.tables import cells, csv_text, geojson


def a_flight(level: float | None = None, **facts: object) -> FlightResults:
    """Return a flight with one result, from which the drone came home with so low a level."""
    rows = ResultRows("flight", BUILT_IN, Meanings((), BUILT_IN, {}), lambda _: "Bed 3")
    did = {"action": "measure", "target": [3.0, 4.5, 1.2], "parameters": {"quantity": "pm10"}}
    event = {"t": 1.5, "event": "trip.completed", "mission": "Field", "trip": "A", "round": 0}
    brought = rows.take({**event, "attempt": 1, "drone": "cf1", "did": did, "result": 3.5, **facts})
    assert brought is not None
    if level is not None:
        rows.take({"t": 9.0, "event": "drone.drained", "drone": "cf1", "level": level})
    result, value = brought
    row = Brought(result=result, wall=1_700_000_000.25, value=value)
    return FlightResults(
        flight="flight", journal=Path("flight.journal"), rows=(row,), pictures=rows.pictures
    )


@pytest.mark.parametrize(
    "name",
    [
        "=1+1",
        "+1",
        "-1",
        "@SUM(A1)",
        *("＝1+1", "＋1", "－1", "＠A1"),
        "\t=1",
        "\r=1",
        "'=1",
        "''",
        'a "b", c\r\nd',
        "µ🐝",
    ],
)
def test_no_text_is_a_formula_and_each_is_read_back(name: str) -> None:
    text = csv_text(cells(a_flight(mission=name)))
    [line] = csv.DictReader(io.StringIO(text.removeprefix("\ufeff"), newline=""))
    assert not line["mission"].startswith(tuple("=+-@＝＋－＠\t\r"))
    assert line["mission"].removeprefix("'") == name


def test_a_row_says_what_where_when_and_in_which_unit() -> None:
    text = csv_text(cells(a_flight(result=-3.5)))
    assert text.startswith("\ufeffnumber,time,wall,")
    assert text.endswith("\r\n")
    [line] = csv.DictReader(io.StringIO(text.removeprefix("\ufeff"), newline=""))
    assert line["wall"] == "2023-11-14T22:13:20.250+00:00"
    assert (line["quantity"], line["value"], line["unit"]) == ("pm10", "-3.5", "")
    assert (line["x"], line["y"], line["z"], line["place"]) == ("3.0", "4.5", "1.2", "Bed 3")


@pytest.mark.parametrize(("level", "cell"), [(None, ""), (0.0, "0.0"), (0.08, "0.08")])
def test_a_row_says_with_which_level_a_drone_came_home_that_broke_its_reserve(
    level: float | None, cell: str
) -> None:
    flight = a_flight(level)
    [line] = csv.DictReader(io.StringIO(csv_text(cells(flight)).removeprefix("\ufeff"), newline=""))
    assert line["drained"] == cell
    collection: Any = geojson(flight, "field")
    assert collection["features"][0]["properties"]["drained"] == level


def test_a_photo_is_the_ground_that_it_shows() -> None:
    """A closed ring, counter-clockwise, with the photo's area."""
    did = {"action": "take_photo", "target": [3.0, 4.5, 1.2], "parameters": {}}
    photo = Photo(position=(3.0, 4.5, 1.2), width=2.0, height=1.0, sees=("bloom",))
    collection: Any = geojson(a_flight(did=did, result=value_data(photo)), "field")
    [feature] = collection["features"]
    [ring] = feature["geometry"]["coordinates"]
    assert ring[0] == ring[-1]
    assert sum(x * v - u * y for (x, y), (u, v) in pairwise(ring)) / 2 == pytest.approx(2.0)


def test_on_the_earth_places_are_degrees() -> None:
    """East of the origin is a greater longitude, by the bearing; heights are above sea level."""
    plane = LocalPlane(45.0, 9.0, altitude=100.0, bearing=pi / 2)
    flight = replace(a_flight(), plane=plane)
    [line] = csv.DictReader(io.StringIO(csv_text(cells(flight)).removeprefix("\ufeff"), newline=""))
    there = (float(line["latitude"]), float(line["longitude"]), float(line["altitude"]))
    assert plane.to_metres(there) == pytest.approx((3.0, 4.5, 1.2), abs=0.002)
    collection: Any = geojson(flight, "field")
    [feature] = collection["features"]
    assert feature["geometry"] == {"type": "Point", "coordinates": [there[1], there[0]]}
    assert feature["properties"]["altitude"] == there[2] == 101.2
    assert "EPSG:4326" in collection["pluto"]["coordinates"]


def test_a_photo_on_the_earth_is_the_ground_that_it_shows() -> None:
    did = {"action": "take_photo", "target": [3.0, 4.5, 1.2], "parameters": {}}
    photo = Photo(position=(3.0, 4.5, 1.2), width=2.0, height=1.0, sees=())
    plane = LocalPlane(-45.0, 179.9999, bearing=0.4)
    flight = replace(a_flight(did=did, result=value_data(photo)), plane=plane)
    collection: Any = geojson(flight, "field")
    [ring] = collection["features"][0]["geometry"]["coordinates"]
    metres = [plane.to_metres((latitude, longitude, 0.0))[:2] for longitude, latitude in ring]
    expected = [(2.0, 4.0), (4.0, 4.0), (4.0, 5.0), (2.0, 5.0), (2.0, 4.0)]
    assert metres == [pytest.approx(corner, abs=0.002) for corner in expected]
