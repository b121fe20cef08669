"""What the command line takes and refuses, and which fleet file it flies where none is named."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import SimpleNamespace

import pytest

from pluto_fleet.cli import plans
from pluto_fleet.cli.options import parse
from pluto_fleet.cli.plans import take_fleet_beside
from pluto_fleet.shared.domain.model import Category
from tests.kit.apps import app, flow
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


@pytest.mark.parametrize(
    "words", ["tell N stop", "journal N --follow", "check N", "resume N --sim"]
)
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


NIGHT = """
[[mission]]
name = "Night"
at = "03:01"
[[mission.trip]]
action = "take_photo"
target = [2, 3]
"""


@pytest.fixture
def in_rome(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let this computer's zone be Rome's."""
    with monkeypatch.context() as patch:
        patch.setenv("TZ", "Europe/Rome")
        time.tzset()
        yield
    time.tzset()


@pytest.mark.usefixtures("in_rome")
def test_a_dry_run_begins_now_by_this_computers_hours(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As `fly` would: here in the night in which clocks are put forward."""
    now = datetime.fromisoformat("2027-03-28T01:59:30+01:00").timestamp()
    monkeypatch.setattr(plans, "time", SimpleNamespace(time=lambda: now))
    missions = tmp_path / "m.toml"
    missions.write_text(NIGHT)
    tested = app(flow(clock=True), categories=[Category(name="scout")])
    code, out, err = command("fly", missions, "--sim", "--dry-run", app=tested)
    assert (code, err) == (0, "")
    waits = "waits 1 min 30 s if it is started at 01:59:30 CET, until 03:01 CEST"
    assert f'mission "Night": {waits}: its first trip is not to start before\n' in out
    assert "\n 90.0 s  cf2    take off" in out
