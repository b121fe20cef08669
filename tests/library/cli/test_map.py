"""`pluto-fleet map`, and `check --write` of what other programs read."""

from __future__ import annotations

import json
from dataclasses import replace
from math import cos, pi, sin
from pathlib import Path
from random import Random

import pytest
import shapely

from pluto_fleet.__main__ import main
from pluto_fleet.cli import main as app_main
from pluto_fleet.files.drawn_map import fewer_corners
from pluto_fleet.files.fleet import load_fleet
from tests.library.files.an_app import APP
from tests.paths import ROOT

SHAPES = ROOT / "tests" / "library" / "files" / "drawings" / "shapes"
FAR = replace(APP, categories=tuple(replace(one, flight_time=36_000.0) for one in APP.categories))
"""With drones that reach all of a field."""
DRONE = '\n[[drone]] # mine\nid = "a"\nhome = [1, 1]\ncategory = "scout"\n'


def put(fleet: Path, name: str, *more: str) -> int:
    return main(["map", f"{fleet}", f"{SHAPES / name}", *more])


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    """A fleet file that was made for a drawing, with a drone."""
    file = tmp_path / "fleet.toml"
    assert put(file, "google_earth.kml") == 0
    file.write_text(file.read_text("utf-8") + DRONE, encoding="utf-8")
    return file


def test_a_fleet_file_is_made_as_large_as_what_is_drawn(fleet: Path) -> None:
    """With its origin a little south-west of everything, and all of it on the map."""
    read = load_fleet(fleet, APP)
    assert read.plane is not None
    assert [one.name for one in read.landmarks.places] == ["Well"]
    assert [one.name for one in read.landmarks.zones] == ["North field"]
    assert len(read.airspace.no_fly) == 1
    corners = [corner for area in read.airspace.no_fly for corner in area]
    assert all(0 <= x <= read.airspace.size[0] - 19 for x, _ in corners)
    assert min(x for x, _ in corners) > 19


def test_what_was_drawn_again_takes_the_place_of_what_was_there(fleet: Path) -> None:
    """The rest of the file keeps its bytes; no-fly areas are there once."""
    before = fleet.read_text("utf-8")
    assert put(fleet, "google_earth.kml") == 0
    assert fleet.read_text("utf-8") == before
    assert put(fleet, "qgis.geojson") == 0
    read = load_fleet(fleet, APP)
    assert [one.name for one in read.landmarks.places] == ["Well", "Trap 1", "Trap 2"]
    assert [one.name for one in read.landmarks.zones] == ["North field"]
    assert len(read.airspace.no_fly) == 1  # both have drawn the same
    assert DRONE in fleet.read_text("utf-8")


def test_all_areas_may_be_closed(fleet: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert put(fleet, "qgis.geojson", "--no-fly") == 0
    assert "2 places, 2 no-fly areas" in capsys.readouterr().out
    assert len(load_fleet(fleet, APP).airspace.no_fly) == 2


@pytest.mark.parametrize(
    ("text", "drawn", "sentence"),
    [
        ("[map]\nsize = [10, 10]\n", "places.csv", "the map has no origin: write one below [map]"),
        (
            "[map]\norigin = { latitude = 45.4642, longitude = 9.19 }\n",
            "places.csv",
            "f.toml, with what is drawn",
        ),
        (
            "[map]\norigin = { latitude = 41.9, longitude = 12.5 }\n",
            "places.csv",
            "is 477 km from the map's origin",
        ),
        ("", "../test_drawings.py", "is not valid TOML"),
    ],
)
def test_what_cannot_be_put_there_is_told_and_the_file_stays(
    text: str, drawn: str, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "f.toml"
    file.write_text(text, encoding="utf-8")
    assert put(file, drawn) == 2
    assert sentence in capsys.readouterr().err
    assert file.read_text("utf-8") == text


def test_a_drawing_is_checked_as_missions_and_written_for_other_programs(
    fleet: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As it is on a map without an origin it is refused, and so is writing degrees from there."""
    out = tmp_path / "out.geojson"
    kml = f"{SHAPES / 'google_earth.kml'}"
    words = ["check", kml, "--fleet", f"{fleet}"]
    assert app_main(FAR, [*words, "--write", f"{out}"]) == 0
    said = capsys.readouterr()
    assert "3 missions with" in said.out
    assert "1 no-fly area in it: `pluto-fleet map`" in said.err
    well = json.loads(out.read_text("utf-8"))["features"][0]
    assert well["geometry"]["coordinates"] == [
        pytest.approx(9.1905, abs=1e-8),
        pytest.approx(45.4645, abs=1e-8),
    ]
    plain = tmp_path / "plain.toml"
    assert app_main(FAR, [*words, "--write", f"{plain}"]) == 0
    assert app_main(FAR, ["check", kml]) == 2
    assert app_main(FAR, ["check", f"{plain}", "--fleet", f"{fleet}"]) == 0
    without = fleet.read_text("utf-8").replace("origin =", "# ")
    fleet.write_text(without, encoding="utf-8")
    again = tmp_path / "again.kml"
    assert app_main(FAR, ["check", f"{plain}", "--fleet", f"{fleet}", "--write", f"{again}"]) == 2
    assert not again.exists()


def test_no_map_is_made_for_what_lies_all_over_the_earth(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn = tmp_path / "cities.csv"
    drawn.write_text("name,lat,lon\nMilan,45.46,9.19\nOslo,59.91,10.75\n", encoding="utf-8")
    assert main(["map", f"{tmp_path / 'f.toml'}", f"{drawn}"]) == 2
    assert "is drawn over more than 10 km" in capsys.readouterr().err
    assert not (tmp_path / "f.toml").exists()


@pytest.mark.parametrize("around", [False, True])
def test_a_boundary_that_was_walked_becomes_one_of_fewer_corners(around: bool) -> None:
    """Where nothing may fly, all of it stays within."""
    chance = Random(7)
    turns = [2 * pi * n / 3000 for n in range(3000)]
    walked = tuple(((100 + chance.gauss(0, 0.001)) * cos(turn), 60 * sin(turn)) for turn in turns)
    outline, note = fewer_corners(walked, around=around)
    assert len(outline) <= 200
    assert "has 3,000 corners, and becomes" in note
    before, after = shapely.Polygon(walked), shapely.Polygon(outline)
    assert before.hausdorff_distance(after) < 0.3
    assert not around or after.contains(before)
