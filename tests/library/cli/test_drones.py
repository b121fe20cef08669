"""`drones`, and `fly --dry-run`: nothing of either arms or moves a drone; what they print is in sessions."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.cli import drones as drones_command
from pluto_fleet.cli.draft_fleet import Answered, write_fleet
from pluto_fleet.drones import localization
from pluto_fleet.files.fleet import load_fleet, not_real
from pluto_fleet.gateway.drone_lock import lock_drones
from tests.library.cli import fake_drones
from tests.library.cli.conftest import Command
from tests.library.cli.fake_drones import ASKED, RECORD, THERE, at
from tests.library.files.an_app import APP

FAKE = f"{fake_drones.__name__}:Fake"

FLEET = (Path(__file__).parent / "sessions" / "drones" / "fleet.toml").read_text("utf-8")


@pytest.fixture(autouse=True)
def _drones(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Let some drones be there, and let those that are not there not be waited for."""
    monkeypatch.setattr(drones_command, "CONNECT_WITHIN", 0.05)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    RECORD.clear()
    THERE.clear()
    THERE["fake://1"] = at((0.52, 0.481, 0.01))
    THERE["fake://4"] = at((1.5, 2.0, 0.0), voltage=3.1)
    yield
    assert {what for _, what in RECORD} <= ASKED  # no matter what was asked, nothing has moved


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    """Four drones: one is ready, one silent, one away, one not well."""
    path = tmp_path / "fleet.toml"
    path.write_text(FLEET, encoding="utf-8")
    return path


def test_a_drone_in_the_air_is_left_alone(fleet: Path, command: Command) -> None:
    """Its link is not closed either: for some drones that would switch the motors off."""
    THERE["fake://1"] = at((1.0, 1.0, 1.2), flying=True)
    code, out, _ = command("drones", "cf1", "--fleet", fleet)
    assert (code, "it is in the air: nothing more was asked of it" in out) == (1, True)
    assert RECORD == [("fake://1", "connect")]


def test_a_drone_that_an_app_flies_is_not_asked(fleet: Path, command: Command) -> None:
    """Two must not speak with one drone."""
    with lock_drones({"x": "fake://1"}):
        code, out, _ = command("drones", "cf1", "--fleet", fleet)
    assert (code, "is commanded by process" in out) == (1, True)
    assert ("fake://1", "connect") not in RECORD


def test_drones_are_told_where_they_are_meanwhile(
    fleet: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the localization of the fleet file; who is not seen is not ready."""
    monkeypatch.setattr(localization, "SILENCE", -1.0)
    mocap = f'localization = "{fake_drones.__name__}:Mocap"\n[localization]\nhost = "lab"\n'
    fleet.write_text(FLEET.replace("[[drone]]", f"{mocap}[[drone]]", 1), encoding="utf-8")
    code, out, _ = command("drones", "cf1", "cf4", "--fleet", fleet)
    assert ("fake://1", "locate") in RECORD
    assert ("fake://4", "locate") not in RECORD
    assert (code, f"no position from {fake_drones.__name__}:Mocap" in out) == (1, True)


def test_what_knows_its_degrees_is_saved_with_a_map_on_the_earth(tmp_path: Path) -> None:
    """As large as where they stand, and each with its home there."""
    there = []
    for number, place in enumerate(((47.0, 8.0, 412.0), (47.0005, 8.001, 411.5)), 1):
        uri = f"mavlink+udp://:14540?system={number}"
        there.append(Answered(uri, (0.0, 0.0, 0.0), place))
    write_fleet(APP, tmp_path / "f.toml", there, "mavlink")
    fleet = load_fleet(tmp_path / "f.toml", APP)
    assert (fleet.plane.altitude if fleet.plane else None) == 411.5
    assert fleet.airspace.size == (120.0, 100.0)
    assert [one.home for one in fleet.drones] == [
        pytest.approx((20.0, 20.0, 0.0), abs=0.2),
        pytest.approx((96.1, 75.6, 0.0), abs=0.2),
    ]
    assert not_real(fleet) is None


def test_nothing_is_saved_where_no_drone_answers(tmp_path: Path, command: Command) -> None:
    """A fleet of none cannot fly."""
    THERE.clear()
    path = tmp_path / "new.toml"
    code, out, err = command("drones", "--navigation", FAKE, "--save", path)
    assert (code, path.exists()) == (2, False)
    assert out == "no drone answers: are they switched on, and near?\n"
    assert err.endswith("not written, for no drone has answered\n")


def test_a_dry_run_reaches_no_drone_and_writes_nothing(command: Command, tmp_path: Path) -> None:
    """The fleet's navigation is not even made, and there is no journal."""
    shutil.copytree(Path(__file__).parent / "sessions" / "dry_run", tmp_path / "plan")
    plan = [tmp_path / "plan/m.toml", "--fleet", tmp_path / "plan/f.toml"]
    before = sorted(tmp_path.rglob("*"))
    assert command("fly", *plan, "--dry-run")[0] == 0
    assert RECORD == []
    assert sorted(tmp_path.rglob("*")) == before
