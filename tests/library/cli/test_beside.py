"""The fleet file beside the missions is flown where no other one is named, and that is said."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from pluto_fleet.cli.options import parse
from pluto_fleet.cli.plans import take_fleet_beside
from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP

FLEET = """
[map]
size = [9, 9]
[[drone]]
id = "mine1"
category = "scout"
home = [1, 1]
[[drone]]
id = "mine2"
category = "carrier"
home = [2, 1]
"""
SCOUT_ONLY = FLEET[: FLEET.rindex("[[drone]]")]
PHOTO = '[[mission]]\n[[mission.trip]]\naction = "take_photo"\ntarget = [2, 3]\n'


@pytest.fixture
def beside(missions: Path) -> Path:
    """A fleet file in the folder of the missions."""
    path = missions.with_name("fleet.toml")
    path.write_text(FLEET)
    return path


def drones(out: str) -> list[str]:
    """Return who flew."""
    return [drone["id"] for drone in json.loads(out)["drones"]]


def test_simulate_flies_the_fleet_beside_the_missions(
    missions: Path, beside: Path, command: Command
) -> None:
    """A line on standard error says which: standard output is for what came of it."""
    code, out, err = command("simulate", missions, "--json")
    assert (code, drones(out)) == (0, ["mine1", "mine2"])
    assert err == f"fleet: {beside}, beside the missions; or name one: --fleet\n"


def test_a_fleet_that_is_named_counts_and_nothing_is_said(
    missions: Path, beside: Path, command: Command
) -> None:
    """As it was before."""
    other = beside.with_name("other.toml")
    other.write_text(FLEET.replace("mine", "other"))
    code, out, err = command("simulate", missions, "--json", "--fleet", other)
    assert (code, drones(out), err) == (0, ["other1", "other2"], "")
    beside.unlink()
    code, out, err = command("simulate", missions, "--json")
    assert (code, len(drones(out)), err) == (0, 5, "")


@pytest.mark.parametrize("command_name", ["simulate", "check"])
def test_what_is_wrong_with_it_is_told(
    missions: Path, beside: Path, command: Command, command_name: str
) -> None:
    """It is not passed over for the default."""
    beside.write_text("[map]\nsize = 3\n")
    code, _, err = command(command_name, missions)
    assert code == 2
    assert f"{beside}:2: " in err


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
    missions: Path, beside: Path, words: list[str], is_taken: bool
) -> None:
    """A file that just lies there moves nothing."""
    options = parse(APP, [str(missions) if word == "M" else word for word in words])
    take_fleet_beside(options)
    assert options.fleet == (beside if is_taken else None)


def test_a_real_flight_asks_for_the_fleet(missions: Path, beside: Path, command: Command) -> None:
    """Though one lies beside the missions."""
    code, _, err = command("fly", missions)
    assert code == 2
    assert "real drones are named in a fleet file: give it with --fleet" in err
    assert err.endswith("; or fly simulated drones: add --sim\n")


def test_a_real_flight_asks_for_uris_or_for_simulated_drones(
    missions: Path, beside: Path, command: Command
) -> None:
    """Once, for all the drones that have none."""
    code, _, err = command("fly", missions, "--fleet", beside)
    assert code == 2
    assert err.count("have no uri") + err.count("has no uri") == 1
    assert err.endswith("; or fly simulated drones: add --sim\n")


def test_an_action_that_no_drone_of_the_fleet_can_do_is_told(
    missions: Path, beside: Path, command: Command
) -> None:
    """Where no trip asks for it that is a warning; where one does, the plan cannot be flown."""
    beside.write_text(SCOUT_ONLY)
    code, _, err = command("check", missions)
    assert code == 2
    assert "trip 2: no drone of the fleet can do it: scout cannot pollinate" in err
    missions.write_text(PHOTO)
    code, out, err = command("check", missions)
    assert (code, out) == (0, "1 mission with 1 trip: a fleet of 1 drone can fly them\n")
    told = [line for line in err.splitlines() if "warning" in line]
    assert told == [
        f"{beside}: warning: no drone of the fleet can {action}: it has no carrier"
        for action in ("pick_item", "release_item", "pollinate")
    ]


def test_a_fleet_that_can_do_all_gives_no_warning(
    missions: Path, beside: Path, command: Command
) -> None:
    """Nor does the default one."""
    assert "warning" not in command("check", missions)[2]
    beside.unlink()
    assert command("check", missions)[2] == ""
