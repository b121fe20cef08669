"""Photos on the Earth say where they were taken, as a mosaic program reads it."""

from __future__ import annotations

import csv
import io
from math import cos, dist, radians, sin
from pathlib import Path
from zipfile import ZipFile

import exifread
import pytest
from exifread.utils import get_gps_coords
from PIL import Image
from pyproj import Transformer

from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.hooks.plain_data import value_data
from pluto_fleet.station.results.exif import with_place
from pluto_fleet.station.results.exports import write_archive
from pluto_fleet.station.results.flights import Brought, FlightResults
from pluto_fleet.station.results.meaning import Meanings
from pluto_fleet.station.results.rows import ResultRows

FIELD = LocalPlane(45.4642, 9.19, altitude=120.0, bearing=radians(30))
PLACE = (-45.4642123, -9.1900001, -12.345)
WALL = 1_700_000_000.25


def a_jpeg(shade: int = 0, **exif: object) -> bytes:
    image = Image.new("RGB", (32, 24), (shade, 90, 30))
    said = image.getexif()
    for tag, value in exif.items():
        said[int(tag.removeprefix("tag"))] = value
    written = io.BytesIO()
    image.save(written, "JPEG", exif=said)
    return written.getvalue()


def a_survey(folder: Path, photos: int) -> FlightResults:
    """Return a flight over a field with so many photos; the last one is a PNG."""
    journal = folder / "flight.journal"
    files = gateway_folder(journal) / "files"
    files.mkdir(parents=True)
    rows = ResultRows("flight", BUILT_IN, Meanings((), BUILT_IN, {}))
    found = []
    for number in range(photos):
        at = (10.0 + 25.0 * (number % 10), 5.0 + 30.0 * (number // 10), 40.0 + number / 10)
        name = f"p{number}.jpg" if number < photos - 1 else "p.png"
        if name.endswith("jpg"):
            (files / name).write_bytes(a_jpeg(number))
        else:
            Image.new("RGB", (8, 8)).save(files / name)
        photo = Photo(position=at, width=30.0, height=20.0, sees=(), file=name)
        did = {"action": "take_photo", "target": [*at], "parameters": {}}
        event = {"t": 2.0 * number, "event": "trip.completed", "mission": "Field", "round": 0}
        rest = {"trip": f"{number}", "attempt": 1, "drone": "v1", "did": did}
        brought = rows.take({**event, **rest, "result": value_data(photo)})
        assert brought is not None
        found.append(Brought(result=brought[0], wall=WALL + 2 * number, value=brought[1]))
    return FlightResults(
        flight="flight", journal=journal, rows=tuple(found), pictures=rows.pictures, plane=FIELD
    )


def test_a_mosaic_program_finds_each_photo_where_it_was_taken(tmp_path: Path) -> None:
    """Fifty of them, read with exifread and put on the map by PROJ; `geo.txt` has the PNG as well."""
    flight = a_survey(tmp_path, 50)
    on_map = Transformer.from_pipeline(
        "+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric +ellps=WGS84"
        f" +lat_0={FIELD.latitude} +lon_0={FIELD.longitude} +h_0={FIELD.altitude}"
    )
    with ZipFile(write_archive(flight, tmp_path / "archives")) as archive:
        table = archive.read("results.csv").decode("utf-8-sig")
        rows = {row["picture"]: row for row in csv.DictReader(io.StringIO(table, newline=""))}
        listed = archive.read("geo.txt").decode().splitlines()
        read = {
            name: exifread.process_file(io.BytesIO(archive.read(name)))
            for name in archive.namelist()
            if name.endswith(".jpg")
        }
    assert len(read) == 49
    for name, tags in read.items():
        latitude, longitude = get_gps_coords(tags) or (0.0, 0.0)
        altitude = float(tags["GPS GPSAltitude"].values[0])
        east, north, _ = on_map.transform(longitude, latitude, FIELD.altitude)
        x = east * cos(FIELD.bearing) - north * sin(FIELD.bearing)
        y = north * cos(FIELD.bearing) + east * sin(FIELD.bearing)
        row = rows[name]
        taken = (float(row["x"]), float(row["y"]), float(row["z"]))
        assert dist((x, y, altitude - 120.0), taken) <= 0.01
    first = read["00001.jpg"]
    assert first["EXIF DateTimeOriginal"].values == "2023:11:14 22:13:20"
    assert first["EXIF FocalLengthIn35mmFilm"].values == [48]  # from 40 m it shows 30 m
    assert first["EXIF ExifImageWidth"].values == [32]
    assert first["EXIF ExifImageLength"].values == [24]
    order = sorted(read, key=lambda name: (f"{read[name]['EXIF DateTimeOriginal']}", name))
    assert order == sorted(read)
    assert listed[0] == "EPSG:4326"
    assert len(listed) == 51
    assert listed[-1].startswith("00050.png 9.19")


def test_a_photo_keeps_its_picture_and_what_it_says_of_itself() -> None:
    before = a_jpeg(tag271="Acme", tag274=6)
    after = with_place(before, PLACE, WALL)
    tags = exifread.process_file(io.BytesIO(after))
    assert get_gps_coords(tags) == pytest.approx(PLACE[:2], abs=1e-8)
    assert tags["GPS GPSAltitudeRef"].values == [1]
    assert float(tags["GPS GPSAltitude"].values[0]) == 12.345
    assert (tags["Image Make"].values, tags["Image Orientation"].values) == ("Acme", [6])
    scan = before.index(b"\xff\xdb")  # from its tables on nothing is another
    assert after.endswith(before[scan:])
    assert after[:2] == b"\xff\xd8"


@pytest.mark.parametrize(
    "content",
    [b"", b"\xff\xd8", b"\x89PNG\r\n\x1a\n", a_jpeg()[:40], with_place(a_jpeg(), PLACE, WALL)],
)
def test_what_is_no_whole_photo_or_knows_its_place_stays_as_it_is(content: bytes) -> None:
    assert with_place(content, (1.0, 2.0, 3.0), 0.0) == content


def test_without_a_place_on_the_earth_photos_stay_as_they_are(tmp_path: Path) -> None:
    flight = a_survey(tmp_path, 2)
    indoors = FlightResults(
        flight="flight", journal=flight.journal, rows=flight.rows, pictures=flight.pictures
    )
    with ZipFile(write_archive(indoors, tmp_path / "archives")) as archive:
        assert archive.read("00001.jpg") == a_jpeg(0)
        assert "geo.txt" not in archive.namelist()
