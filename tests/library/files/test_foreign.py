"""Files of colleagues: with a mark before the text, in other encodings, or of other programs."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.cli import main
from tests.library.files.an_app import APP
from tests.library.station.server.asking import asked, said, without

MISSIONS = '[[mission]]\nname = "Süd"\n[[mission.trip]]\naction = "take_photo"\ntarget = [1, 2]\n'
EARTH = "its places are degrees on the Earth, and here they are metres on the map: write those"
SHEET = 'save its sheet as "CSV UTF-8"; each = "NAME.csv" in a missions file makes a mission of each row'
FEATURES = '{"type": "FeatureCollection", "features": []}'
KML = '<?xml version="1.0"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark/></kml>'
LONG = f"{MISSIONS}priority = {'9' * 5000}\n"
OTHERS = [
    (b"PK\x03\x04\x14\0\6\0[Content_Types].xml\xff\xfe xl/workbook.xml", f"is an Excel workbook, and not TOML: {SHEET}"),
    (b"PK\x03\x04\0mimetypeapplication/vnd.oasis.opendocument.spreadsheet\xff", "is a spreadsheet of LibreOffice, and"),
    (b"PK\x03\x04\x14\0\xffdoc.kml", f"is a KMZ file, and not TOML: {EARTH}"),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0", "is a workbook or document of an old Office, and not TOML"),
    (b"SQLite format 3\0\xff", "is a database, such as a journal, and not TOML"),
    (b"\x89PNG\r\n\x1a\n\0", "is a PDF or a picture, and not TOML"),
    ('{\n "mission": {},\n "fileType": "Plan"}', f"is a plan of QGroundControl, and not TOML: {EARTH}"),
    ("\ufeff" + FEATURES, f"is GeoJSON, and not TOML: {EARTH}"),
    ('{"coordinates": [1, 2], "type":"Point"}', f"is GeoJSON, and not TOML: {EARTH}"),
    ("QGC WPL 110\n0\t1\t0\n", f"is a list of waypoints of a ground station, and not TOML: {EARTH}"),
    (KML, f"is KML, and not TOML: {EARTH}"),
    ("<gpx><wpt/></gpx>", f"is GPX, and not TOML: {EARTH}"),
    ("<!DOCTYPE html><p>Not found", "is XML or HTML, and not TOML: this is another file"),
    ('[\n {"x": 1}]', "is JSON, and not TOML: write it as docs/files.md has it"),
    ("# beds\n\npluto 1\n\napp crop {\n}\n", "is the source of an app, and not TOML: its missions are another file"),
    ("nr;x;y\n1;2;3\n", "is a list (CSV), and not TOML: a missions file names it, each"),
    (MISSIONS.encode("utf-16"), ":1: is not UTF-8 text but UTF-16: save it as UTF-8"),
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


def _imported(content: bytes) -> tuple[int, str]:
    headers = without("content-type", content_type="application/toml")
    reply = asked()("POST", "/api/plan/import", content, headers, revision="1", file="other")
    return reply.status, said(reply) if reply.status != 200 else reply.body.decode()


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_a_mark_before_the_text_is_no_part_of_it(encoding: str, tmp_path: Path) -> None:
    """Wherever a missions file is taken in: by commands, by the station, and under a name."""
    content = MISSIONS.encode(encoding)
    (tmp_path / "m.toml").write_bytes(content)
    assert main(APP, ["check", f"{tmp_path / 'm.toml'}"]) == 0
    assert _imported(content)[0] == 200
