"""What a fleet file may hold, and what is said of one that cannot be flown."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pluto_fleet.app import App
from pluto_fleet.files.fleet import (
    DroneEntry,
    FleetFile,
    default_fleet,
    load_fleet,
    navigation_of,
    not_real,
    options_of,
)
from pluto_fleet.files.landmarks import NO_LANDMARKS, Landmarks, Picture
from pluto_fleet.files.writing import fleet_text
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import Feature, Source, WorldData
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.library.files.an_app import APP, PLAIN

FULL = """
[map]
size = [20.0, "1200 cm"]
image = "ward.svg"
cruise_height = 1.5
ceiling = "4 m"
no_fly = [[[8, 0], [9, 0], [9, 5], [8, 5]]]

[fleet]
after_trip = "stay"
apart = "40 cm"
max_airborne = 5
silence = "2 s"
localization = "lab.mocap:Mocap"

[localization]
host = "10.0.0.7"

[navigation.crazyflie]
measure = { temperature = "bme.temp" }
limits = [0.5, 2, true]

[[drone]]
id = "cf1"
category = "scout"
home = [0.5, 0.5]
uri = "radio://0/80/2M/E7E7E7E7E1"
[drone.options]
camera = "192.168.4.1:5000"

[[drone]]
id = "cf2"
category = "carrier"
home = [1.5, 0.5, 0.1]
navigation = "boats"

[world]
background = { pm10 = 15.0 }
[[world.feature]]
kind = "bloom"
at = [2, 3]
radius = "20 cm"
[[world.feature]]
kind = "pest"
at = [3, 3]
[[world.source]]
quantity = "pm10"
at = [4, 4]
peak = 80
radius = "3 m"
"""


def load(path: Path, text: str, app: App = APP) -> FleetFile:
    file = path / "fleet.toml"
    file.write_text(text, encoding="utf-8")
    return load_fleet(file, app)


def test_a_file_says_where_drones_fly_and_how(tmp_path: Path) -> None:
    """The map, the fleet's behaviour, each drone with its line, and the simulated world."""
    assert load(tmp_path, FULL) == FleetFile(
        airspace=Airspace(
            size=(20.0, 12.0),
            cruise_height=1.5,
            ceiling=4.0,
            no_fly=(((8.0, 0.0), (9.0, 0.0), (9.0, 5.0), (8.0, 5.0)),),
        ),
        landmarks=Landmarks(picture=Picture(file="ward.svg", size=(20.0, 12.0))),
        after_trip=AfterTrip.STAY,
        apart=0.4,
        max_airborne=5,
        silence=2.0,
        motion=CRAZYFLIE,
        navigation="crazyflie",
        options={
            "crazyflie": {"measure": {"temperature": "bme.temp"}, "limits": [0.5, 2, True]},
        },
        localization="lab.mocap:Mocap",
        localization_options={"host": "10.0.0.7"},
        drones=(
            DroneEntry(
                id="cf1",
                category="scout",
                home=(0.5, 0.5, 0.0),
                uri="radio://0/80/2M/E7E7E7E7E1",
                options={"camera": "192.168.4.1:5000"},
                line=23,
            ),
            DroneEntry(
                id="cf2", category="carrier", home=(1.5, 0.5, 0.1), navigation="boats", line=31
            ),
        ),
        world=WorldData(
            features=(
                Feature(kind="bloom", at=(2.0, 3.0), radius=0.2),
                Feature(kind="pest", at=(3.0, 3.0)),
            ),
            sources=(Source(quantity="pm10", at=(4.0, 4.0), peak=80.0, radius=3.0),),
            background={"pm10": 15.0},
        ),
    )


def test_only_the_drones_must_be_given(tmp_path: Path) -> None:
    """And not even their category, where the app has but one."""
    fleet = load(tmp_path, '[[drone]]\nid = "a"\nhome = [1, 1]', PLAIN)
    drone = DroneEntry(id="a", category="drone", home=(1.0, 1.0, 0.0), line=1)
    assert fleet == FleetFile(airspace=Airspace(), drones=(drone,), motion=CRAZYFLIE)
    assert fleet.after_trip is AfterTrip.NEXT
    assert fleet.world is None


def test_without_a_file_five_drones_stand_along_an_edge() -> None:
    """The app's categories in turn, a metre apart."""
    fleet = default_fleet(APP)
    assert [(drone.id, drone.category) for drone in fleet.drones] == [
        ("cf1", "scout"),
        ("cf2", "carrier"),
        ("cf3", "scout"),
        ("cf4", "carrier"),
        ("cf5", "scout"),
    ]
    assert [drone.home[0] for drone in fleet.drones] == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert all(fleet.airspace.problem(drone.home) is None for drone in fleet.drones)


def test_a_drone_goes_by_its_own_navigation_and_options(tmp_path: Path) -> None:
    """What [drone.options] holds lies on top of its navigation's, key by key."""
    fleet = load(tmp_path, FULL)
    first, second = fleet.drones
    assert navigation_of(fleet, first) == "crazyflie"
    assert navigation_of(fleet, second) == "boats"
    assert {**options_of(fleet, first)} == {
        "measure": {"temperature": "bme.temp"},
        "limits": [0.5, 2, True],
        "camera": "192.168.4.1:5000",
    }
    assert options_of(fleet, second) == {}


def test_a_crazyflie_without_a_uri_cannot_really_fly(tmp_path: Path) -> None:
    """Each is named with its line; one that another navigation flies need not have one."""
    bare = FULL.replace('uri = "radio://0/80/2M/E7E7E7E7E1"\n', "")
    assert not_real(load(tmp_path, FULL)) is None
    assert not_real(load(tmp_path, bare)) == (
        'drone "cf1" (line 23) has no uri, where a real drone is reached: add one, such as'
        ' uri = "radio://0/80/2M/E7E7E7E7E7"'
    )


def test_without_a_file_nothing_can_really_fly() -> None:
    """The default fleet is made up: the message says how to get a file."""
    said = not_real(default_fleet(APP))
    assert said is not None
    assert "give it with --fleet" in said
    assert "drones --save F.toml" in said


def test_a_fleet_that_is_written_is_read_the_same(tmp_path: Path) -> None:
    """All but the lines, and the floor plan's file, which lies beside the first."""
    fleet = load(tmp_path, FULL)
    again = load(tmp_path, fleet_text(fleet))
    drones = [replace(drone, line=None) for drone in fleet.drones]
    assert [replace(drone, line=None) for drone in again.drones] == drones
    assert replace(again, drones=()) == replace(fleet, drones=(), landmarks=NO_LANDMARKS)
