"""`drones` with cflib itself, and simulated Crazyflies at the other end of a radio."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.files.fleet import load_fleet
from tests.library.cli.conftest import Command
from tests.library.crtp import radio
from tests.library.crtp.radio import Ether, plugged_in
from tests.library.files.an_app import APP

pytest.importorskip("cflib")

HARMLESS = {"asked", "set led.bitmask"}
"""What may be done to a drone that shall neither be armed nor moved."""


def test_crazyflies_are_found_by_radio_and_written_into_a_fleet_file(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With their homes where they stand. Without a dongle it is said what is missing."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    record = FlightLog()
    path = tmp_path / "fleet.toml"
    builds = [Build(id=f"cf{n}", home=(float(n), 1.0, 0.0), seed=n) for n in (1, 2)]
    ether = Ether(builds, record)
    words = ["drones", "--address", "E7E7E7E701", "--address", "E7E7E7E702"]
    with plugged_in(ether):
        code, out, _ = command(*words, "--save", path)
        assert code == 0, out
        assert [line.split()[1] for line in out.splitlines()[1:3]] == list(ether.uris.values())
    nothing = Ether([], record)
    nothing.unplugged = True
    with plugged_in(nothing):
        code, out, err = command(*words)
        assert (code, out) == (2, "")
        assert "no Crazyradio is plugged in" in err
        assert "Traceback" not in err
    assert {command.what for command in record.commands} <= HARMLESS
    fleet = load_fleet(path, APP)
    assert [drone.uri for drone in fleet.drones] == list(ether.uris.values())
    for number, drone in enumerate(fleet.drones, start=1):
        assert drone.home == pytest.approx((float(number), 1.0, 0.0), abs=0.1)


def test_all_dongles_are_scanned_and_each_drone_is_found_once(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One that two of them hear is the first one's; one that cannot be opened hides no other's."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(radio, "_NO_ANSWER", 0.0)
    build = Build(id="cf1", home=(1.0, 1.0, 0.0), seed=1)
    record = FlightLog()
    other = Build(id="cf2", home=(2.0, 1.0, 0.0), seed=2)
    ethers = [Ether([build], record), Ether([build, other], record)]
    words = ["drones", "--address", "E7E7E7E701", "--address", "E7E7E7E702"]
    with plugged_in(*ethers):
        _, out, _ = command(*words)
    there = [line.split()[1] for line in out.splitlines()[1:3]]
    assert there == ["radio://0/80/2M/E7E7E7E701", "radio://1/80/2M/E7E7E7E702"]
    code, _, err = command("drones", "--address", "E7E7E7")
    assert (code, '"E7E7E7" is a radio address of 6 digits' in err) == (2, True)
