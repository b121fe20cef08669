"""The wind of a fleet file: read, refused with what is wrong with it, counted with, and written again."""

from __future__ import annotations

from math import radians
from pathlib import Path

import pytest

from pluto_fleet.files.fleet import FleetFile, gusty, load_fleet
from pluto_fleet.files.writing import fleet_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.wind import power
from tests.library.files.an_app import APP

DRONE = '[[drone]]\nid = "m1"\ncategory = "scout"\nhome = [1, 1]\n'
STEADY = f'{DRONE}[motion]\nlegs = "steady"\n'
WIND = '[world.wind]\nspeed = "6 m/s"\nfrom = "240 deg"\n'


def read(folder: Path, text: str) -> FleetFile:
    path = folder / "fleet.toml"
    path.write_text(text, "utf-8")
    return load_fleet(path, APP)


def wrong(folder: Path, text: str) -> list[str]:
    with pytest.raises(BadInput) as caught:
        read(folder, text)
    return [line.partition(": ")[2] for line in str(caught.value).splitlines()]


@pytest.mark.parametrize(
    ("on_map", "x", "y"),
    [
        ("", 6.0, 0.0),
        ("north = 90\n", 0.0, -6.0),
        ('origin = { latitude = 47, longitude = 8 }\nbearing = "90 deg"\n', 0.0, 6.0),
    ],
)
def test_a_wind_blows_on_the_map_from_where_the_compass_says(
    tmp_path: Path, on_map: str, x: float, y: float
) -> None:
    """From the west, to the east: along x, unless the map is turned."""
    west = '[world.wind]\nspeed = 6\nfrom = "270 deg"\n'
    fleet = read(tmp_path, f"[map]\n{on_map}{STEADY}{west}")
    assert fleet.motion.wind == pytest.approx((x, y), abs=1e-9)
    assert fleet.motion.effort >= power(6.0)


def test_a_world_with_nothing_but_a_wind_is_made_up_as_without_one(tmp_path: Path) -> None:
    """With and without the library, which alone counts with it."""
    fleet = read(tmp_path, STEADY + WIND)
    alone = files.load_fleet(tmp_path / "fleet.toml", APP)
    assert fleet.world is alone.world is None
    assert alone.motion.wind == ()
    empty = read(tmp_path, f"{STEADY}[world]\nbackground = {{}}\n{WIND}")
    assert empty.world is not None


def test_a_wind_is_written_as_it_was_read(tmp_path: Path) -> None:
    """And counted with once, not again each time."""
    first = read(tmp_path, f'{STEADY}drain = "120 %"\n{WIND}gusts = "2 m/s"\n')
    again = read(tmp_path, fleet_text(first))
    assert again.wind == first.wind
    assert again.motion == first.motion
    assert first.wind is not None
    assert first.wind.origin == pytest.approx(radians(240.0))


def test_what_is_wrong_with_a_wind_is_told(tmp_path: Path) -> None:
    such = 'such as from = "240 deg"'
    assert wrong(tmp_path, STEADY + '[world.wind]\nspeed = "6 m"\ngust = 2\n') == [
        '[world], wind: unknown key "gust"; did you mean "gusts"? there may be: speed, from, gusts',
        f"[world], wind: has no from, the compass direction that it comes from, {such}",
        '[world], wind: speed "6 m" is a length, not a speed: it takes m/s, km/h',
    ]


def test_a_wind_that_none_can_fly_against_is_refused(tmp_path: Path) -> None:
    """Gusts are a matter of a warning."""
    strong = '[world.wind]\nspeed = "16 m/s"\nfrom = 0\n'
    most = "drones that fly at up to 15 m/s through the air (airspeed of [motion])"
    [refused] = wrong(tmp_path, STEADY + strong)
    assert refused == f"[world], wind: 16 m/s blow away {most}: nothing may take off"
    assert read(tmp_path, f'{STEADY}airspeed = "20 m/s"\n{strong}').wind is not None
    [warned] = gusty(read(tmp_path, f"{STEADY}{WIND}gusts = 9.5\n"))
    assert warned.startswith("gusts reach 15.5 m/s, and drones fly at up to 15 m/s")
    assert gusty(read(tmp_path, STEADY + WIND)) == []


def test_only_legs_of_multicopters_outdoors_have_a_wind(tmp_path: Path) -> None:
    assert wrong(tmp_path, DRONE + WIND) == [
        '[world], wind: is for multicopters outdoors, by [motion] legs = "steady": these fly smooth legs'
    ]
