"""The examples that people fly outdoors: with other files, and vehicles that speak MAVLink, the same apps."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from dataclasses import replace
from functools import partial
from math import cos, sin
from pathlib import Path
from zipfile import ZipFile

import exifread
import pytest
import shapely
from exifread.utils import get_gps_coords
from PIL import Image
from pyproj import Transformer

from pluto_fleet.app import App
from pluto_fleet.cli import main as fleet_main
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.station.results.exports import write_archive
from pluto_fleet.station.results.flights import ResultsOfFlights
from tests.kit.apps import EXAMPLES, example
from tests.kit.command import run

NAMES = ("aerial_mapping", "alfalfa", "pm10", "pursue")
FILES = ("outdoors_missions.toml", "--fleet", "outdoors.toml")
MINUTES = 9


@pytest.mark.parametrize("name", NAMES)
def test_the_same_app_completes_on_a_field(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is warned of, and each mission is completed."""
    monkeypatch.chdir(EXAMPLES / name)
    checked = run(partial(fleet_main, example(name).app), "check", *FILES)
    assert (checked.code, checked.err) == (0, "")
    assert "warning" not in checked.out
    ran = run(partial(fleet_main, example(name).app), "simulate", *FILES)
    assert ran.code == 0, ran.out + ran.err
    completed = re.search(r"(\d+) of (\d+) missions completed", ran.out)
    assert completed is not None
    assert completed[1] == completed[2]


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("make", ["px4", "ardupilot"])
def test_simulated_autopilots_fly_it(make: str, tmp_path: Path) -> None:
    """Through MAVSDK, in real time, with photos on the way by what their cameras tell."""
    pytest.importorskip("mavsdk")
    one = example("aerial_mapping")
    fleet = (EXAMPLES / one.name / "outdoors.toml").read_text(encoding="utf-8")
    options = f'\n[navigation.mavlink]\nautopilot = "{make}"\n\n[[drone]]'
    (tmp_path / "outdoors.toml").write_text(fleet.replace("\n[[drone]]", options, 1))
    missions = EXAMPLES / one.name / FILES[0]
    words = ("fly", missions, *FILES[1:], "--mavlink-sim", "2", "--journal", "flown.journal")
    ran = subprocess.run(
        [sys.executable, "-m", one.name, *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(one.package / "src")},
        capture_output=True,
        text=True,
        timeout=60 * MINUTES,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "4 of 4 missions completed" in ran.stdout
    fleet_file = load_fleet(tmp_path / "outdoors.toml", one.app)
    plan = load_missions(missions, one.app, fleet_file.airspace)
    lines = [shapely.LineString([trip.source, trip.target]) for one in plan for trip in one.trips]
    found = read_by_a_mosaic_program(one.app, tmp_path / "flown.journal")
    assert len(found) >= 40  # some are taken again, where it has arrived: within half a metre
    for place, height in found:
        assert min(line.distance(shapely.Point(place)) for line in lines) < 1.0
        assert height > 19.5


def read_by_a_mosaic_program(app: App, journal: Path) -> list[tuple[tuple[float, float], float]]:
    """Return where the photos of a flight were taken, on the map, as their EXIF says and PROJ has it.

    Its cameras keep their pictures: others stand in for them.
    """
    flown = ResultsOfFlights(app, journal.parent).of(journal.stem)
    plane = flown.plane
    assert plane is not None
    files = gateway_folder(journal) / "files"
    files.mkdir(exist_ok=True)
    Image.new("RGB", (32, 24)).save(files / "photo.jpg")
    numbers = [one.result["number"] for one in flown.rows if one.result["kind"] == "photo"]
    flown = replace(flown, pictures=dict.fromkeys(numbers, "photo.jpg"))
    on_map = Transformer.from_pipeline(
        "+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric +ellps=WGS84"
        f" +lat_0={plane.latitude} +lon_0={plane.longitude} +h_0={plane.altitude}"
    )
    found = []
    taken = []
    with ZipFile(write_archive(flown, journal.parent / "archives")) as archive:
        for number in numbers:
            tags = exifread.process_file(io.BytesIO(archive.read(f"{number:05}.jpg")))
            latitude, longitude = get_gps_coords(tags) or (0.0, 0.0)
            east, north, _ = on_map.transform(longitude, latitude, plane.altitude)
            turn = plane.bearing
            x = east * cos(turn) - north * sin(turn)
            y = north * cos(turn) + east * sin(turn)
            altitude = float(tags["GPS GPSAltitude"].values[0])
            found.append(((x, y), altitude - plane.altitude))
            taken.append(f"{tags['EXIF DateTimeOriginal']}.{tags['EXIF SubSecTimeOriginal']}")
    assert taken == sorted(taken)
    return found
