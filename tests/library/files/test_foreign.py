"""Files of colleagues: with a mark before the text, in other encodings, or of other programs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from pluto_fleet.cli import main
from pluto_fleet.files.landmarks import Landmarks
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.station.config import StationConfig
from tests.library.files.an_app import APP
from tests.library.station.server.asking import NOWHERE, AStation, asked, said, without

MISSIONS = '[[mission]]\nname = "Süd"\n[[mission.trip]]\naction = "take_photo"\ntarget = [1, 2]\n'
EARTH = "export its places as GeoJSON or KML, which are taken"
SHEET = 'save its sheet as "CSV UTF-8"; each = "NAME.csv" in a missions file makes a mission of each row'
FIELD = replace(
    NOWHERE,
    fleet=replace(
        NOWHERE.fleet,
        airspace=Airspace(size=(300.0, 200.0), ceiling=50.0),
        landmarks=Landmarks(plane=LocalPlane(45.4642, 9.19, altitude=120.0)),
    ),
)
LONG = f"{MISSIONS}priority = {'9' * 5000}\n"
OTHERS = [
    (b"PK\x03\x04\x14\0\6\0[Content_Types].xml\xff\xfe xl/workbook.xml", f"is an Excel workbook, and not TOML: {SHEET}"),
    (b"PK\x03\x04\0mimetypeapplication/vnd.oasis.opendocument.spreadsheet\xff", "is a spreadsheet of LibreOffice, and"),
    (b"PK\x03\x04\x14\0\xffdoc.kml", "is a KMZ file, and not TOML: unpack it"),
    (b"PK\x03\x04\x14\0wpmz/template.kml\xff", f"is a flight of DJI (WPML, in a KMZ file), and not TOML: {EARTH}"),
    (b"PK\x03\x04\x14\0fields.shp\xff", f"is a shapefile in a zip archive, and not TOML: {EARTH}"),
    (b"\0\0\x27\x0a\0\0\0\0", f"is a shapefile, and not TOML: {EARTH}"),
    (b"SQLite format 3\0" + b"\0" * 52 + b"GPKG", f"is a GeoPackage, and not TOML: {EARTH}"),
    (b"II*\0\x08\0", "is a TIFF picture, and not TOML"),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0", "is a workbook or document of an old Office, and not TOML"),
    (b"SQLite format 3\0\xff", "is a database, such as a journal, and not TOML"),
    (b"\x89PNG\r\n\x1a\n\0", "is a PDF or a picture, and not TOML"),
    ("<gpx><wpt/></gpx>", f"is GPX, and not TOML: {EARTH}"),
    ("<!DOCTYPE html><p>Not found", "is XML or HTML, and not TOML: this is another file"),
    ('[\n {"x": 1}]', "is JSON, and not TOML: write it as docs/files.md has it"),
    ("# beds\n\npluto 1\n\napp crop {\n}\n", "is the source of an app, and not TOML: its missions are another file"),
    ("nr;x;y\n1;2;3\n", "is a list (CSV), and not TOML: a missions file names it, each"),
    (MISSIONS.encode("utf-16"), ":1: is not UTF-8 text but UTF-16: save it as UTF-8"),
    ("lat,lon\n45,9\n".encode("utf-16"), ":1: is not UTF-8 text but UTF-16: save it as UTF-8"),
    (MISSIONS.encode("utf-16-le"), "is UTF-16, or no text, and not TOML: save it as UTF-8"),
    (MISSIONS.encode("latin-1"), ":2: is not UTF-8 text: save it as UTF-8"),
    (LONG, ":6: is not valid TOML: a whole number has too many digits"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "sentence"), OTHERS)
def test_another_file_is_called_what_it_is(
    given: str | bytes, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As missions and as a fleet, and where the station takes a file in."""
    content = given if isinstance(given, bytes) else given.encode()
    other = tmp_path / "other"
    good = tmp_path / "good.toml"
    other.write_bytes(content)
    good.write_text(MISSIONS, encoding="utf-8")
    for command in (["check", f"{other}"], ["check", f"{good}", "--fleet", f"{other}"]):
        assert main(APP, command) == 2
        assert f"{other}{'' if sentence[0] == ':' else ': '}{sentence}" in capsys.readouterr().err
    answer = _imported(content)
    assert answer[0] == 400 and sentence.removeprefix(":") in answer[1]


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("google_earth.kml", "KML"),
        ("qgis.geojson", "GeoJSON"),
        ("qgroundcontrol.plan", "a plan of QGroundControl"),
        ("mission_planner.waypoints", "a list of waypoints of a ground station"),
        ("places.csv", "a list of places"),
    ],
)
def test_a_drawing_is_no_fleet_and_needs_a_map_on_the_earth(
    name: str, what: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The station takes it as the commands do."""
    drawn = Path(__file__).parent / "drawings" / "shapes" / name
    good = tmp_path / "good.toml"
    good.write_text(MISSIONS, encoding="utf-8")
    assert main(APP, ["check", f"{good}", "--fleet", f"{drawn}"]) == 2
    assert f"is {what}, and not TOML: it is taken as missions" in capsys.readouterr().err
    assert main(APP, ["check", f"{drawn}"]) == 2
    assert f"is {what}, whose places are degrees on the Earth" in capsys.readouterr().err
    status, answer = _imported(drawn.read_bytes())
    assert status == 400 and f"other: is {what}, whose places" in answer
    status, answer = _imported(drawn.read_bytes(), FIELD)
    assert status == 200 and '"take_photo"' in answer


def _imported(content: bytes, config: StationConfig = NOWHERE) -> tuple[int, str]:
    headers = without("content-type", content_type="application/toml")
    reply = asked(AStation(APP, config))(
        "POST", "/api/plan/import", content, headers, revision="1", file="other"
    )
    return reply.status, said(reply) if reply.status != 200 else reply.body.decode()


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_a_mark_before_the_text_is_no_part_of_it(encoding: str, tmp_path: Path) -> None:
    """Wherever a missions file is taken in: by commands, by the station, and under a name."""
    content = MISSIONS.encode(encoding)
    (tmp_path / "m.toml").write_bytes(content)
    assert main(APP, ["check", f"{tmp_path / 'm.toml'}"]) == 0
    assert _imported(content)[0] == 200


def test_a_drawing_without_anything_in_it_is_called_empty(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And not a plan without missions."""
    drawing = tmp_path / "field.KML"
    drawing.write_bytes(b" \n")
    assert main(APP, ["check", f"{drawing}"]) == 2
    assert f"{drawing}: is empty: save it again" in capsys.readouterr().err
