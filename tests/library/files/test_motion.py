"""`[motion]` in a fleet file: how its drones move, read with and without the library, and written again."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files.fleet import FleetFile, default_fleet, load_fleet
from pluto_fleet.files.writing import fleet_text
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.alone.simulate import default_fleet as default_fleet_alone
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT, Motion
from pluto_fleet.shared.domain.values import MOTION
from tests.library.files.an_app import APP

DRONE = '[[drone]]\nid = "cf1"\ncategory = "scout"\nhome = [1, 1]\n'


def read(text: str) -> Motion:
    """Return what a fleet file says, with and without the library."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "fleet.toml")
        path.write_text(text, "utf-8")
        motion = load_fleet(path, APP).motion
        assert files.load_fleet(path, APP).motion == motion
    return motion


@pytest.mark.parametrize(
    ("line", "key", "value"),
    [
        ('limit = "72 km/h"', "limit", 20.0),
        ("limit = 0.6", "limit", 0.6),
        ('take_off = "700 ms"', "take_off", 0.7),
        ("settles = 0", "settles", 0.0),
        ('landing = "1 min"', "landing", 60.0),
        ('pace = "120 %"', "pace", 1.2),
        ('spread = "8 %"', "spread", 0.08),
        ("action_spread = 0.3", "action_spread", 0.3),
        ('drain = "90 %"', "drain", 0.9),
        ('taper = "0 %"', "taper", 0.0),
    ],
)
def test_each_key_changes_its_part_of_the_motion(line: str, key: str, value: Any) -> None:
    """A Crazyflie's, or that of drones that fly straight."""
    assert read(f"{DRONE}[motion]\n{line}") == replace(CRAZYFLIE, **{key: value})
    straight = f'{DRONE}[motion]\nlegs = "straight"\n{line}'
    assert read(straight) == replace(STRAIGHT, **{key: value})


def test_what_is_not_said_is_a_crazyflies() -> None:
    """Without a file, too; only a fleet that is made in Python flies straight by default."""
    for text in (DRONE, f"{DRONE}[motion]", f'{DRONE}[motion]\nlegs = "smooth"'):
        assert read(text) == CRAZYFLIE
    assert read(f'{DRONE}[motion]\nlegs = "straight"') == STRAIGHT
    assert default_fleet(APP).motion == default_fleet_alone(APP).motion == CRAZYFLIE
    made = FleetFile(airspace=default_fleet(APP).airspace, drones=default_fleet(APP).drones)
    assert made.motion == STRAIGHT


def test_everything_but_the_slack_can_be_said() -> None:
    """How far a drone is off its way is no matter of its pace; the wind is the world's."""
    said = {one.name for one in fields(Motion)} & MOTION.keys()
    assert {one.name for one in fields(Motion)} - said == {"slack", "wind", "effort"}


def test_all_that_is_wrong_is_told_at_once_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "fleet.toml"
    path.write_text(f'{DRONE}[motion]\nlegs = "round"\nwind = 3\nspread = "50 %"\nlimit = "1 m"\n')
    with pytest.raises(BadInput) as caught:
        load_fleet(path, APP)
    assert str(caught.value).splitlines() == [
        f'{path}:7: [motion]: unknown key "wind"; there may be: {", ".join(MOTION)}',
        f'{path}:6: [motion]: legs "round" is none of: smooth, steady, straight',
        f'{path}:9: [motion]: limit "1 m" is a length, not a speed: it takes m/s, km/h',
        f'{path}:8: [motion]: spread "50 %" is not a percent (%) of 0 % to 30 %',
    ]


def shares(least: float, most: float) -> st.SearchStrategy[float]:
    """Return numbers as a person writes them."""
    return st.floats(least, most).map(lambda share: min(most, max(least, round(share, 3))))


changes = st.fixed_dictionaries(
    {},
    optional={
        "limit": shares(0.01, 100.0),
        **dict.fromkeys(("take_off", "settles", "landing"), shares(0.0, 600.0)),
        **dict.fromkeys(("pace", "drain"), shares(0.1, 10.0)),
        **dict.fromkeys(("spread", "action_spread"), shares(0.0, 0.3)),
        "taper": shares(0.0, 0.5),
    },
)


@given(st.sampled_from([CRAZYFLIE, STRAIGHT]), changes)
def test_what_is_written_is_read_again(usual: Motion, changed: dict[str, Any]) -> None:
    """And no more of it than differs from the default."""
    motion = replace(usual, **changed)
    written = fleet_text(replace(default_fleet(APP), motion=motion))
    assert read(written) == motion
    assert ("[motion]" in written) == (motion != CRAZYFLIE)
    for key, value in changed.items():
        assert (f"\n{key} = " in written) == (value != getattr(usual, key))
