"""Where a fleet file's map lies on the Earth; what is said of mistakes is in `sentences/fleets.txt`."""

from __future__ import annotations

from math import pi

import pytest

from pluto_fleet.files.fleet import fleet_of
from pluto_fleet.files.reading import parsed
from pluto_fleet.files.writing import fleet_text
from pluto_fleet.geodesy import LocalPlane
from tests.library.files.an_app import APP

FIELD = """
[map]
size = [300, 200]
origin = { latitude = 45.4642, longitude = 9.19, altitude = "120 m" }
bearing = "30 deg"
[[drone]]
id = "a"
home = [1, 1]
category = "scout"
"""


def test_a_map_has_an_origin_and_a_bearing_and_north_follows_from_it() -> None:
    fleet = fleet_of(parsed("f.toml", FIELD), APP)
    assert fleet.plane == LocalPlane(45.4642, 9.19, 120.0, pytest.approx(pi / 6))  # type: ignore[arg-type]
    assert fleet.landmarks.north == -30.0


def test_a_written_fleet_lies_where_it_did() -> None:
    fleet = fleet_of(parsed("f.toml", FIELD), APP)
    assert fleet_of(parsed("f.toml", fleet_text(fleet)), APP).plane == fleet.plane


def test_indoors_there_is_no_place_on_the_earth() -> None:
    fleet = fleet_of(parsed("f.toml", FIELD.replace("origin", "# ").replace("bearing", "#")), APP)
    assert fleet.plane is None
