"""What other programs draw becomes missions: files in the shapes that they write are in `shapes/`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import shapely

from pluto_fleet.files.drawings.feature import Feature, Kind
from pluto_fleet.files.drawings.writing import WRITERS, geojson_text, kml_text, plan_text
from pluto_fleet.files.drawn_missions import features_of
from pluto_fleet.files.kinds import drawing_in
from pluto_fleet.files.landmarks import NO_LANDMARKS, Landmarks
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import Document, decoded, parsed
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.files.an_app import APP

SHAPES = Path(__file__).parent / "shapes"
FARM = Landmarks(plane=LocalPlane(45.4642, 9.19, altitude=120.0))
FIELD = Airspace(size=(300.0, 200.0), cruise_height=10.0, ceiling=50.0)
WELL = (39.104, 33.343)
SQUARE = "[[[9.1902,45.4643],[9.1904,45.4643],[9.1904,45.4644],[9.1902,45.4643]]]"


def read(text: str, landmarks: Landmarks = FARM) -> Document:
    """Read a drawing as a missions file is read."""
    document = parsed("drawn", decoded(text.encode(), "drawn"))
    document.landmarks = landmarks
    return document


def missions(text: str) -> list[Any]:
    return missions_of(read(text), APP, FIELD)


def made(text: str) -> list[tuple[str, int, tuple[float, ...]]]:
    """Return the missions of a drawing: name, trips, and the first place to a centimetre."""
    found = missions(text)
    return [(m.name, len(m.trips), tuple(round(v, 2) for v in m.trips[0].target)) for m in found]


def shape(name: str) -> str:
    return (SHAPES / name).read_text("utf-8")


def test_google_earth() -> None:
    """A placemark with a height, an area that says how it is flown, a path; a folder of what may not be entered."""
    assert made(shape("google_earth.kml")) == [
        ("Well", 1, (39.10, 33.34, 12.0)),
        ("North field", 6, (49.53, 58.54, 10.0)),
        ("Ditch", 3, (15.64, 11.11, 10.0)),
    ]


def test_qgis() -> None:
    """Features that say nothing are left out of nothing; fields of the app are taken, and others are not."""
    found = missions(shape("qgis.geojson"))
    assert [one.name for one in found] == ["North field", "Traps"]
    assert {trip.priority for trip in found[0].trips} == {3}
    assert [(trip.name, trip.action) for trip in found[1].trips] == [
        ("Trap 1", "measure"),
        ("Trap 2", "measure"),
    ]
    assert found[1].trips[0].target == pytest.approx((15.642, 11.114, 3.0), abs=0.001)


@pytest.mark.parametrize("name", ["qgroundcontrol.plan", "mission_planner.waypoints"])
def test_ground_stations(name: str) -> None:
    """Heights are above home or above sea level, as each waypoint says; what is no place is told."""
    document = read(shape(name))
    first, *others = missions_of(document, APP, FIELD)
    assert [trip.target for trip in first.trips] == [
        pytest.approx((35.194, 27.786, 25.0), abs=0.001),
        pytest.approx((70.388, 44.458, 25.0), abs=0.001),
    ]
    if name.endswith(".plan"):
        assert [len(one.trips) for one in others] == [6]
        assert "fences to stay within are left out: 1" in document.notes
        assert (
            "1 no-fly area in it: `pluto-fleet map` puts such into a fleet file"
            in document.notes[-1]
        )
    else:
        assert document.notes == ["changes of speed are left out: 1"]


def test_a_list_of_places() -> None:
    assert made("\ufeff" + shape("places.csv")) == [
        ("Bed 1", 1, (15.64, 11.11, 3.0)),
        ("Bed 2", 1, (31.28, 22.23, 10.0)),
    ]


def test_what_a_circle_keeps_out_lies_within_its_corners() -> None:
    drawing = drawing_in(shape("qgroundcontrol.plan"))
    assert drawing is not None
    [around] = [one for one in drawing.features if one.kind is Kind.NO_FLY]
    plane = LocalPlane(45.4652, 9.1925)
    corners = [plane.to_metres((one.latitude, one.longitude, 0.0)) for one in around.spots]
    edges = zip(corners, corners[1:] + corners[:1], strict=True)
    middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in edges]
    assert min((x * x + y * y) ** 0.5 for x, y in middles) >= 15.0 - 1e-6


@pytest.mark.parametrize("ending", WRITERS)
def test_missions_come_back_from_every_format(ending: str) -> None:
    """To a centimetre; `python -m tests.geodesy` does it all over the Earth."""
    places = [[10.0, 20.0, 5.0], [299.0, 1.5, 49.0], [123.456, 78.9, 10.0]]
    trips = [{"name": f"t {n}", "action": "measure", "target": at} for n, at in enumerate(places)]
    data = {"mission": [{"name": 'M <1> & "2"', "trip": trips}]}
    before = missions_of(Document("", data), APP, FIELD)
    plane = FARM.plane
    assert plane is not None
    after = missions(WRITERS[ending](features_of(before, plane)))
    assert len(after) == 1
    for was, trip in zip(before[0].trips, after[0].trips, strict=True):
        assert trip.target == pytest.approx(was.target, abs=0.01)
    if ending != ".plan":  # which has neither names nor actions
        assert after[0].name == before[0].name
        assert [(one.name, one.action) for one in after[0].trips] == [
            (one["name"], "measure") for one in trips
        ]


@pytest.mark.parametrize("write", [geojson_text, kml_text, plan_text])
def test_no_fly_areas_come_back(write: Any) -> None:
    drawing = drawing_in(shape("qgis.geojson"))
    assert drawing is not None
    forbidden = [one for one in drawing.features if one.kind is Kind.NO_FLY]
    again = drawing_in(write(forbidden))
    assert again is not None
    assert [(one.kind, sorted(one.spots)) for one in again.features] == [
        (one.kind, sorted(one.spots)) for one in forbidden
    ]


def test_geojson_is_written_as_its_standard_wants() -> None:
    """Areas run counter-clockwise, and end where they begin."""
    drawing = drawing_in(f'{{"type":"Polygon","coordinates":{SQUARE}}}')
    assert drawing is not None
    corners = drawing.features[0].spots
    for spots in (corners, corners[::-1]):
        [written] = json.loads(geojson_text([Feature(kind=Kind.AREA, who="", spots=spots)]))[
            "features"
        ]
        [ring] = written["geometry"]["coordinates"]
        assert ring[0] == ring[-1]
        assert shapely.LinearRing(ring).is_ccw


def _feature(geometry: str, properties: str = "{}") -> str:
    return f'{{"type":"Feature","properties":{properties},"geometry":{geometry}}}'


def _kml(inner: str, before: str = "") -> str:
    return f'<?xml version="1.0"?>{before}<kml xmlns="http://www.opengis.net/kml/2.2"><Document>{inner}</Document></kml>'


BOMB = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 9))
REFUSED = [
    (_feature('{"type":"Point","coordinates":[1512000.5,5034000]}'), "feature 1 has a latitude of 5.034e+06, which is none in degrees: save it in WGS 84"),
    (_feature('{"type":"Point","coordinates":[9.19]}'), "feature 1 has no coordinates that can be read"),
    (_feature('{"type":"Point","coordinates":["9","45"]}'), "feature 1 has a latitude that is no number of degrees"),
    (_feature('{"type":"Point","coordinates":[45.4643,9.1902]}', '{"name":"A"}'), 'feature 1, "A", is 5,154 km from the map\'s origin: a map reaches 20 km; its latitude and longitude are the wrong way round'),
    (_feature('{"type":"Point","coordinates":[9.1902,46.4643]}'), "feature 1 is 111 km from the map's origin: a map reaches 20 km; `pluto-fleet map` makes a fleet file whose map lies there"),
    (_feature('{"type":"Circle","coordinates":[9,45]}'), "feature 1 is of no known type of geometry"),
    (_feature(f'{{"type":"Polygon","coordinates":{SQUARE}}}'), "does not say how far its places are apart: give it a property spacing"),
    (_feature(f'{{"type":"Polygon","coordinates":{SQUARE[:-1]},{SQUARE[1:-1]}]}}', '{"spacing":5}'), "has a hole, and an area is flown over as a whole"),
    (_feature('{"type":"Polygon","coordinates":[[[9,45],[9,45.1],[9,45]]]}'), "is no area: it has fewer than three corners"),
    ('{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[]}', 'has coordinates of "EPSG:32632": save it in WGS 84'),
    ('{"type":"FeatureCollection","features":[]}', "is GeoJSON, and has no places and no areas"),
    ('{"type":"FeatureCollection","features":[', "cannot be read as GeoJSON: "),
    ('{"type":"Point","coordinates":' + "[" * 90 + "]" * 90 + "}", "is nested deeper than 64"),
    ('{"fileType":"Plan","mission":{"items":[{"type":"ComplexItem","complexItemType":"survey"}]}}', "survey 1 (item 1) is no area"),
    ('{"fileType":"GeoFence"}', "is of QGroundControl, but no plan of it"),
    ('{"type":"Topology","arcs":[]}', "is TopoJSON, and not TOML: export its places as GeoJSON"),
    (_kml("<Placemark><Point><coordinates>9,45;x</coordinates></Point></Placemark>"), "placemark 1 has coordinates that are no numbers: 9,45;x"),
    (_kml("<NetworkLink><name>far</name></NetworkLink>"), "has no places of its own, but links to other files"),
    (_kml("", f'<!DOCTYPE kml [<!ENTITY l0 "lol">{BOMB}]>'), "has a document type, which no KML needs: take it out"),
    (_kml("&x;", '<!DOCTYPE kml SYSTEM "file:///etc/passwd">'), "has a document type"),
    (_kml("<Folder>" * 200 + "</Folder>" * 200), "is nested deeper than 100"),
    (_kml("<Placemark>")[:-20], "cannot be read as KML: "),
    (_kml('<x xmlns:wpml="http://www.dji.com/wpmz/1.0.6"/>'), "is a flight of DJI (WPML): export"),
    ("QGC WPL 110\n1\t0\t3\n", "has no waypoint in row 2: a row has 12 numbers"),
    ("QGC WPL 100\n", "is a list of waypoints of another version than 110"),
    ("lat,lon\n45°27',9°11'\n", "row 2 has a latitude \"45°27'\", which is not a number of degrees, such as 47.39774"),
    ("lat,lon\n45.4643\n", "has 1 value in row 2"),
    ('name;lat;lon\nA;"45,4643";9,19\n', 'row 2, "A", has a latitude "45,4643", which is not a number of degrees; a number has a point'),
]  # fmt: skip


@pytest.mark.parametrize(("text", "sentence"), REFUSED)
def test_what_cannot_be_taken_is_told(text: str, sentence: str) -> None:
    with pytest.raises(BadInput) as caught:
        missions(text)
    assert sentence in str(caught.value)


def test_without_an_origin_one_is_proposed() -> None:
    with pytest.raises(BadInput, match="the map has no origin") as caught:
        missions_of(read(shape("places.csv"), NO_LANDMARKS), APP, FIELD)
    assert "origin = { latitude = 45.464300, longitude = 9.190200 }" in str(caught.value)


def test_a_drawing_is_bounded() -> None:
    many = "lat,lon\n" + "45,9\n" * 10_001
    with pytest.raises(BadInput, match="too many rows: at most 10,000 are taken"):
        missions(many)
    with pytest.raises(BadInput, match="is larger than 8192 KiB"):
        decoded(b'{"type":"FeatureCollection"' + b" " * (9 << 20), "drawn")
