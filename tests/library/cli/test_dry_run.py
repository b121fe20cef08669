"""`fly --dry-run`: what every drone would be told; none is, and nothing is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.library.cli import fake_drones
from tests.library.cli.conftest import Command
from tests.library.cli.fake_drones import RECORD

EXPECTED = Path(__file__).with_name("dry_run.txt")

FLEET = f"""
[map]
size = [10, 6]
no_fly = [[[3, 1], [3.5, 1], [3.5, 4], [3, 4]]]
[fleet]
navigation = "{fake_drones.__name__}:Fake"
[motion]
take_off = "1 s"
settles = "0.2 s"
landing = "2 s"
[[drone]]
id = "cf1"
category = "scout"
home = [1, 1]
uri = "fake://1"
[[drone]]
id = "cf2"
category = "carrier"
home = [1, 2]
uri = "fake://2"
"""

MISSIONS = """
[[mission]]
name = "Pills"
[[mission.trip]]
action = "pick_item"
item = { name = "pills", mass = "4 g" }
target = [2, 3]
[[mission.trip]]
action = "release_item"
item = { name = "pills", mass = "4 g" }
target = [5, 2]
[[mission]]
name = "Look"
[[mission.trip]]
action = "measure"
parameters = { quantity = "pm10" }
target = [5, 3]
[[mission.trip]]
action = "pollinate"
parameters = { dose = "40 mg" }
target = [6, 3]
"""


@pytest.fixture(autouse=True)
def _nothing_is_done(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Let all that would be written by default be written where it can be seen."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    RECORD.clear()


@pytest.fixture
def plan(tmp_path: Path) -> list[str]:
    """The words that name two missions, and a fleet of two drones that are not simulated."""
    (tmp_path / "m.toml").write_text(MISSIONS, encoding="utf-8")
    (tmp_path / "f.toml").write_text(FLEET, encoding="utf-8")
    return [str(tmp_path / "m.toml"), "--fleet", str(tmp_path / "f.toml")]


def test_every_command_is_printed(plan: list[str], command: Command, update: bool) -> None:
    """When, to which drone, what, where to, how fast at most; then what came of the missions."""
    code, out, err = command("fly", *plan, "--dry-run")
    if update:
        EXPECTED.write_text(out, encoding="utf-8")
    assert (code, err) == (0, "")
    assert out == EXPECTED.read_text(encoding="utf-8")


def test_no_drone_is_reached_and_nothing_is_written(
    plan: list[str], command: Command, tmp_path: Path
) -> None:
    """The fleet's navigation is not even made, and there is no journal."""
    before = sorted(tmp_path.rglob("*"))
    assert command("fly", *plan, "--dry-run")[0] == 0
    assert RECORD == []
    assert sorted(tmp_path.rglob("*")) == before


def test_what_fly_would_refuse_is_told(plan: list[str], command: Command) -> None:
    """After the commands, and the exit code is that of the refusal."""
    fleet = Path(plan[-1])
    fleet.write_text(FLEET.replace(":Fake", ":Fak"), encoding="utf-8")
    code, out, err = command("fly", *plan, "--dry-run")
    assert (code, "take off" in out) == (2, True)
    assert err.startswith("alfalfa fly would not begin:\n")
    assert 'did you mean "Fake"?' in err
    assert command("fly", *plan, "--dry-run", "--sim")[0] == 0  # simulated drones need none


def test_a_drone_that_lacks_what_the_plan_asks_for_is_told(
    plan: list[str], command: Command
) -> None:
    """As far as its navigation knows that without reaching it; a bad option is told likewise."""
    missions = Path(plan[0])
    looks = MISSIONS.replace("measure", "take_photo").replace(
        'parameters = { quantity = "pm10" }\n', ""
    )
    missions.write_text(looks, encoding="utf-8")
    code, out, err = command("fly", *plan, "--dry-run")
    assert (code, "take_photo" in out) == (2, True)
    assert err == "cf1 would not be flown: fake://1 has no camera\n"
    fleet = Path(plan[-1])
    plain = FLEET.replace(f"{fake_drones.__name__}:Fake", "crazyflie")
    fleet.write_text(f'{plain}[drone.options]\ncamra = "10.0.0.1:5000"\n', encoding="utf-8")
    code, out, err = command("fly", *plan, "--dry-run")
    assert code == 2
    assert err.startswith(f"alfalfa fly would not begin:\n{fleet}:16: "), err
    assert '"camra"' in err
    assert command("fly", *plan, "--dry-run", "--crtp-sim", "2") == (2, out, err)
    assert RECORD == []


def test_letting_a_whole_category_stay_at_home_is_told(plan: list[str], command: Command) -> None:
    """Fewer simulated Crazyflies than the fleet has drones: the first ones are flown."""
    _, _, err = command("fly", *plan, "--dry-run", "--crtp-sim", "1")
    assert err.startswith(
        "no carrier flies: --crtp-sim 1 takes only 1 of the fleet file's 2 drones"
    )


def test_a_flight_that_would_fail_is_told_with_its_reason(
    plan: list[str], command: Command
) -> None:
    """And the exit code is that of `simulate`."""
    code, out, _ = command("fly", *plan, "--dry-run", "--sim", "--fail", "action=100%")
    assert code == 1
    assert "refused, or not done:\n" in out
    assert "Pills: trip 1 failed (cf2): pick_item failed" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--journal x", "--journal is for a flight, and --dry-run is none: leave one out\n"),
        ("--supervise", "--supervise is for a flight, and --dry-run is none: leave one out\n"),
        ("--seed 3", "--seed is for simulated drones: it goes with --sim\n"),
    ],
)
def test_what_belongs_to_flights_is_refused(
    plan: list[str], command: Command, words: str, said: str
) -> None:
    """A dry run is no flight."""
    assert command("fly", *plan, "--dry-run", *words.split()) == (2, "", said)


def test_it_can_end_at_a_time(plan: list[str], command: Command) -> None:
    """What repeats for ever must; a flight, however, is stopped by a person."""
    missions = Path(plan[0])
    missions.write_text(
        MISSIONS.replace('name = "Look"', 'name = "Look"\nrepeat = true'), encoding="utf-8"
    )
    code, _, err = command("fly", *plan, "--dry-run")
    assert (code, "say when with --until" in err) == (2, True)
    code, out, _ = command("fly", *plan, "--dry-run", "--until", "20 s")
    assert code == 0
    assert float(out.split("\n\n")[0].split("\n")[-1].split()[0]) <= 20.0
    code, _, err = command("fly", *plan, "--until", "20 s")
    assert (code, "--until goes with --dry-run" in err) == (2, True)
