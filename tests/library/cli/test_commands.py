"""What the command line takes and refuses, and which fleet file it flies where none is named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from pluto_fleet.cli.options import parse
from pluto_fleet.cli.plans import take_fleet_beside
from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP


def test_check_warns_of_a_speed_that_a_crazyflie_does_not_follow(
    missions: Path, command: Command
) -> None:
    """Before a person stands there with drones that will not take off; other drones may."""
    first, *others = APP.categories
    fast = replace(APP, categories=(replace(first, speed=1.5), *others))
    fleet = missions.with_name("f.toml")
    drones = [
        f'[[drone]]\nid = "{one.name}"\ncategory = "{one.name}"\nhome = [{at}, 1]\n'
        for at, one in enumerate(APP.categories, 1)
    ]
    fleet.write_text("".join(drones))
    code, _, said = command("check", missions, "--fleet", fleet, app=fast)
    assert code == 0 and said.count("\n") == 1
    assert said.startswith(
        f'{fleet}: warning: drones of the category "{first.name}" fly at up to 1.5 m/s: a Crazyflie'
        " follows no course faster than 1 m/s as its firmware comes"
    )
    assert command("check", missions, "--fleet", fleet)[2] == ""
    fleet.write_text('[fleet]\nnavigation = "wren:Wren"\n' + fleet.read_text())
    assert command("check", missions, "--fleet", fleet, app=fast)[2] == ""


@pytest.mark.parametrize("words", ["tell N stop", "journal N --mend", "check N", "resume N --sim"])
def test_a_name_that_is_too_long_is_told(words: str, command: Command) -> None:
    code, _, said = command(*words.replace("N", "n" * 300).split())
    assert code == 2
    assert "too long" in said and "internal" not in said


@pytest.mark.parametrize(
    ("words", "is_taken"),
    [
        (["simulate", "M", "--runs", "2"], True),
        (["size", "M"], True),
        (["check", "M"], True),
        (["fly", "M", "--sim"], True),
        (["fly", "M", "--crtp-sim", "2"], True),
        (["fly", "M", "--sim", "--dry-run"], True),
        (["serve", "--sim", "--missions", "M"], True),
        (["fly", "M"], False),
        (["fly", "M", "--dry-run"], False),
        (["serve", "--missions", "M"], False),
        (["serve", "--sim"], False),
        (["drones"], False),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_real_drones_fly_only_by_a_fleet_that_is_named(
    missions: Path, words: list[str], is_taken: bool
) -> None:
    """A file that just lies there moves nothing."""
    beside = missions.with_name("fleet.toml")
    beside.touch()
    options = parse(APP, [str(missions) if word == "M" else word for word in words])
    take_fleet_beside(options)
    assert options.fleet == (beside if is_taken else None)
