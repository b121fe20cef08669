"""`pluto-fleet map` with a GeoTIFF: it becomes the picture of the map, where it lies."""

from __future__ import annotations

from math import cos, dist, radians, sin
from pathlib import Path
from random import Random

import pytest
from PIL import Image
from PIL.TiffImagePlugin import ImageFileDirectory_v2
from pyproj import Transformer

from pluto_fleet.__main__ import main
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.utm import from_utm
from pluto_fleet.geodesy import LocalPlane
from tests.library.files.an_app import APP

FLEET = """\
[map] # the farm
size = [300, 200]
origin = { latitude = 47.397742, longitude = 8.545594 }
bearing = "30 deg"

[[drone]]
id = "a"
home = [1, 1]
category = "scout"
"""
PLANE = LocalPlane(47.397742, 8.545594, bearing=radians(30))
UTM_32 = 32632
PIXELS = (400, 300)


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    file = tmp_path / "fleet.toml"
    file.write_text(FLEET, encoding="utf-8")
    return file


def corner(code: int) -> tuple[float, float]:
    """Return where the upper left corner of the picture lies in a reference system."""
    latitude, longitude, _ = PLANE.to_degrees((20.0, 150.0, 0.0))
    x, y = Transformer.from_crs(4326, code, always_xy=True).transform(longitude, latitude)
    return x, y


def a_tiff(
    file: Path, code: int | None, side: float, mode: str = "RGB", compression: str = "raw"
) -> Path:
    """Write a TIFF whose pixels have a side, in metres or degrees; without a code it says nothing of itself."""
    tags = ImageFileDirectory_v2()
    if code is not None:
        x, y = corner(code)
        key = 2048 if code == 4326 else 3072
        tags[33550] = (side, side, 0.0)
        tags[33922] = (0.0, 0.0, 0.0, x, y, 0.0)
        tags.tagtype[34735] = 3
        tags[34735] = (1, 1, 0, 2, 1025, 0, 1, 1, key, 0, 1, code)
    Image.new(mode, PIXELS).save(file, tiffinfo=tags, compression=compression)
    return file


@pytest.mark.parametrize("compression", ["raw", "tiff_lzw", "tiff_adobe_deflate"])
@pytest.mark.parametrize(("mode", "ending"), [("RGB", "jpg"), ("RGBA", "webp"), ("L", "jpg")])
def test_an_orthophoto_in_utm_lies_where_it_says(
    mode: str, ending: str, compression: str, fleet: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As PROJ has its corners, to 5 cm; grid north is not true north. All else in the file is kept."""
    tiff = a_tiff(fleet.with_name("field.tif"), UTM_32, 0.5, mode, compression=compression)
    assert main(["map", f"{fleet}", f"{tiff}"]) == 0
    assert f"its picture is field.{ending}, from [" in capsys.readouterr().out
    read = load_fleet(fleet, APP)
    picture = read.landmarks.picture
    assert picture is not None
    assert fleet.read_text("utf-8").startswith("[map] # the farm\nsize = [300, 200]\n")
    with Image.open(fleet.with_name(picture.file)) as shown:
        assert shown.size == PIXELS
    x, y = corner(UTM_32)
    to_degrees = Transformer.from_crs(UTM_32, 4326)
    turn = radians(picture.turn)
    for right, up in ((0, 0), (1, 0), (0, 1), (1, 1)):
        latitude, longitude = to_degrees.transform(x + right * 200.0, y - 150.0 + up * 150.0)
        there = PLANE.to_metres((latitude, longitude, 0.0))[:2]
        wide, high = right * picture.size[0], up * picture.size[1]
        here = (
            picture.at[0] + wide * cos(turn) + high * sin(turn),
            picture.at[1] - wide * sin(turn) + high * cos(turn),
        )
        assert dist(here, there) < 0.05
    assert main(["map", f"{fleet}", f"{tiff}"]) == 0  # once more, in place of itself


def test_one_in_degrees_lies_north_up(fleet: Path) -> None:
    tiff = a_tiff(fleet.with_name("field.tif"), 4326, 5e-6)
    assert main(["map", f"{fleet}", f"{tiff}"]) == 0
    picture = load_fleet(fleet, APP).landmarks.picture
    assert picture is not None
    assert picture.turn == pytest.approx(-30.0, abs=0.01)
    assert picture.size == pytest.approx((151.0, 166.8), abs=0.1)


def refused(fleet: Path, tiff: Path, capsys: pytest.CaptureFixture[str]) -> str:
    """Return why a file is not taken; nothing changes then."""
    before = fleet.read_bytes()
    assert main(["map", f"{fleet}", f"{tiff}"]) == 2
    assert fleet.read_bytes() == before
    return capsys.readouterr().err


@pytest.mark.parametrize(
    ("code", "side", "mode", "why"),
    [
        (31468, 0.5, "RGB", "is in EPSG:31468, and taken are WGS 84 in degrees"),
        (None, 0.5, "RGB", "is in no known reference system"),
        (UTM_32, 0.5, "F", "has measurements in its pixels, such as heights"),
        (UTM_32, 100.0, "RGB", "km from the map's origin: a map reaches 20 km"),
        (UTM_32, 0.0, "RGB", "lies on the ground as in a mirror, or covers none"),
        (4326, 30.0, "RGB", "at no place on the Earth"),
    ],
)
def test_what_is_no_picture_of_this_ground_is_refused(
    code: int | None,
    side: float,
    mode: str,
    why: str,
    fleet: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    tiff = a_tiff(fleet.with_name("field.tif"), code, side, mode)
    said = refused(fleet, tiff, capsys)
    assert said.startswith(f"{tiff}: ")
    assert why in said


def test_a_file_that_was_cut_off_is_refused(
    fleet: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tiff = a_tiff(fleet.with_name("field.tif"), UTM_32, 0.5, compression="tiff_lzw")
    whole = tiff.read_bytes()
    for length in (4, 9, 200, len(whole) // 2, len(whole) - 300):
        tiff.write_bytes(whole[:length])
        assert "cannot be read as a TIFF" in refused(fleet, tiff, capsys)


def test_it_is_told_what_stands_in_the_way(fleet: Path, capsys: pytest.CaptureFixture[str]) -> None:
    tiff = a_tiff(fleet.with_name("field.tif"), UTM_32, 0.5)
    mine = fleet.with_name("field.jpg")
    mine.write_bytes(b"mine")
    assert "is there already, and is not the map's picture" in refused(fleet, tiff, capsys)
    assert mine.read_bytes() == b"mine"
    fleet.write_text(FLEET.replace("origin", "# origin").replace("bearing", "# bearing"))
    assert "the map has no origin: write one below [map]" in refused(fleet, tiff, capsys)


def test_all_zones_are_where_proj_has_them() -> None:
    """To a micrometre, at places drawn by chance."""
    rng = Random(0)
    for zone in range(1, 61):
        for code, is_south in ((32600 + zone, False), (32700 + zone, True)):
            east = rng.uniform(170_000, 830_000)
            north = abs(rng.uniform(0, 9_300_000) - 10_000_000 * is_south)
            wanted = Transformer.from_crs(code, 4326).transform(east, north)
            found = from_utm(zone, east, north, is_south=is_south)
            assert found[0] == pytest.approx(wanted[0], abs=1e-11)
            assert (found[1] - wanted[1] + 180) % 360 - 180 == pytest.approx(0, abs=1e-10)
