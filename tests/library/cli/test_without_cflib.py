"""Without cflib everything works but flying Crazyflies, and that says what to install."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import pluto_fleet
from tests.library.cli.conftest import Command

SAID = "to fly Crazyflies, cflib is needed: pip install 'pluto-fleet[crazyflie]'\n"

FLEET = """
[[drone]]
id = "cf1"
category = "scout"
home = [1, 1]
uri = "radio://0/80/2M/E7E7E7E7E1"
[[drone]]
id = "cf2"
category = "carrier"
home = [2, 1]
uri = "radio://0/80/2M/E7E7E7E7E2"
"""

EVERYTHING = """
import sys
from importlib import import_module
from pkgutil import walk_packages
sys.path.insert(0, sys.argv[1])
for name in ("cflib", "mavsdk", "pymavlink"):
    sys.modules[name] = None  # as where it is not installed
alone = ("pluto_fleet.autopilot.", "pluto_fleet.mavlink.mavsdk_process")  # processes of their own
import pluto_fleet
for module in walk_packages(pluto_fleet.__path__, "pluto_fleet."):
    if not module.name.endswith("__main__") and not module.name.startswith(alone):
        import_module(module.name)
"""


@pytest.fixture
def fleet(missions: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A fleet of Crazyflies, where there is no cflib."""
    monkeypatch.setitem(sys.modules, "cflib", None)
    monkeypatch.setenv("XDG_STATE_HOME", str(missions.parent / "state"))
    path = missions.with_name("f.toml")
    path.write_text(FLEET, encoding="utf-8")
    return path


@pytest.mark.parametrize("lacks", ["mavsdk", "pymavlink"])
def test_fly_says_what_to_install_for_vehicles_that_speak_mavlink(
    missions: Path, command: Command, monkeypatch: pytest.MonkeyPatch, lacks: str
) -> None:
    """Those that are simulated need both packages of the extra."""
    monkeypatch.setitem(sys.modules, lacks, None)
    code, said, told = command("fly", missions, "--mavlink-sim", "5")
    assert (code, said) == (2, "")
    assert told.endswith("is needed: pip install 'pluto-fleet[mavlink]'\n")


@pytest.mark.parametrize("supervise", [[], ["--supervise"]])
def test_fly_says_what_to_install_before_anything_begins(
    missions: Path, fleet: Path, command: Command, supervise: list[str]
) -> None:
    """No journal is begun, where one was named or not, and no gateway is started."""
    journal = missions.with_name("j.journal")
    before = sorted(missions.parent.rglob("*"))
    words = ["fly", missions, "--fleet", fleet, *supervise]
    assert command(*words) == (2, "", SAID)
    assert command(*words, "--journal", journal) == (2, "", SAID)
    assert sorted(missions.parent.rglob("*")) == before


def test_a_station_says_so_before_it_serves(missions: Path, fleet: Path, command: Command) -> None:
    """Its folder is not made, and nothing listens."""
    folder = missions.with_name("kept")
    code, out, err = command("serve", "--fleet", fleet, "--folder", folder, "--port", "0")
    assert (code, out, err) == (2, "", SAID)
    assert not folder.exists()


def test_drones_says_so_too(missions: Path, fleet: Path, command: Command) -> None:
    """Before it looks for any."""
    assert command("drones") == (2, "", SAID)
    assert command("drones", "--fleet", fleet) == (2, "", SAID)
    assert command("drones", "--fleet", fleet, "--identify", "cf1") == (2, "", SAID)


def test_all_else_works(missions: Path, fleet: Path, command: Command) -> None:
    """What needs no radio."""
    assert command("check", missions, "--fleet", fleet)[0] == 0
    assert command("simulate", missions, "--fleet", fleet)[0] == 0
    code, out, err = command("fly", missions, "--fleet", fleet, "--dry-run")
    assert (code, "take off" in out) == (2, True)
    assert err.endswith(SAID)


@pytest.mark.long
@pytest.mark.process
def test_every_module_of_the_library_is_imported_without_it() -> None:
    """It is imported when a radio is opened, and no sooner."""
    home = Path(pluto_fleet.__path__[0]).parent
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", EVERYTHING, home],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
