"""The library flies drones where no app, no compiler and no brain but its own copy can be imported."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
import tomlkit

import pluto_fleet
from pluto_fleet.crtp import process as crtp
from pluto_fleet.gateway.process import LOG
from pluto_fleet.gateway.starting import connect
from pluto_fleet.process import respawn
from tests.kit.apps import compiled
from tests.library.gateway.flights import Commander, Task
from tests.library.gateway.processes import Brain, pid, played, settings
from tests.paths import ROOT

pytestmark = [pytest.mark.long, pytest.mark.process]
APP = "drugs_distribution"
WRENS = [ROOT / "docs/navigation"]
FLEET = """
[map]
size = [20.0, 20.0]
[fleet]
navigation = "drugs_distribution.drones:Own"
[[drone]]
id = "w1"
category = "nurse"
home = [1.0, 0.5]
uri = "wren:100,50"
"""
MISSIONS = """
[[mission]]
name = "M"
[[mission.trip]]
action = "measure"
target = [2, 2]
"""


_PROGRAM = (
    "import sys; sys.path[:0] = sys.argv[1:3]; del sys.argv[1:3]; "
    "from pluto_fleet.__main__ import main; sys.exit(main())"
)


def installed(folder: Path) -> tuple[str, ...]:
    """Install the library, and what it needs, into a folder; return the command of its program.

    Nothing else is on that program's path, and no variable of the environment changes that.
    """
    no_caches = shutil.ignore_patterns("__pycache__")
    library = folder / "pluto_fleet"
    shutil.copytree(pluto_fleet.__path__[0], library, ignore=no_caches)
    needed = folder / "needed"
    for package in (msgspec, tomlkit):
        shutil.copytree(package.__path__[0], needed / package.__name__, ignore=no_caches)
    return (sys.executable, "-I", "-S", "-c", _PROGRAM, str(folder), str(needed))


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, ...]:
    """The command of the library's program."""
    return installed(tmp_path_factory.mktemp("site"))


@pytest.mark.process
def test_every_module_that_needs_no_extra_can_be_imported(program: tuple[str, ...]) -> None:
    """By the author of a navigation, for one: it is the library's own brain that they share."""
    code = (
        "import sys; from importlib import import_module; from pkgutil import walk_packages\n"
        "sys.path[:0] = sys.argv[1:3]\n"
        "import pluto_fleet\n"
        "names = [one.name for one in walk_packages(pluto_fleet.__path__, 'pluto_fleet.')]\n"
        "out = ('pluto_fleet.shared', 'pluto_fleet.cli.plot', 'pluto_fleet.files.sweep',\n"
        "       'pluto_fleet.autopilot', 'pluto_fleet.mavlink.mavsdk_process')\n"
        "web = ('api', 'handlers', 'live', 'server')\n"
        "out = (*out, *(f'pluto_fleet.station.web.{one}' for one in web))\n"
        "for name in names:\n"
        "    if not name.startswith(out): import_module(name)\n"
        "import pluto_fleet.shared.domain.errors as errors; print(len(names), errors.__file__)\n"
    )
    *first, _, folder, needed = program
    done = subprocess.run(
        [*first, code, folder, needed], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    number, home = done.stdout.split()
    assert int(number) > 200
    assert home == f"{folder}/pluto_fleet/shared/domain/errors.py"


@pytest.mark.long
def test_the_program_says_its_version(program: tuple[str, ...]) -> None:
    done = subprocess.run([*program, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.endswith(
        "\nextras: not installed: areas, crazyflie, mavlink, plot, station\n"
    )


@pytest.mark.long
def test_the_gateway_flies_from_its_settings_alone(
    program: tuple[str, ...], tmp_path: Path
) -> None:
    async def play(brain: Brain) -> None:
        link = await connect(tmp_path, settings(), brain.kernel, 1, command=[*program, "gateway"])
        brain.links.append(link)
        commander = Commander(link)
        assert await brain.flown(commander, Task()) is None
        await brain.told(commander.land("cf1"))
        await link.goodbye()
        await brain.until(lambda: pid(tmp_path) is None)

    played(tmp_path, play)
    assert "the gateway ends" in (tmp_path / LOG).read_text(encoding="utf-8")


@pytest.mark.long
def test_simulated_crazyflies_need_no_app(program: tuple[str, ...], tmp_path: Path) -> None:
    homes = {"cf1": (1.0, 1.0, 0.0), "cf2": (2.0, 1.0, 0.0)}
    try:
        uris = crtp.start(tmp_path, homes, [*program, "crtp"])
        assert list(uris) == ["cf1", "cf2"]
        assert json.loads(crtp.told(tmp_path, "uris")) == uris
    finally:
        crtp.end(tmp_path)


def test_both_are_the_library_s_own_processes() -> None:
    """Whichever app flies: its package is not named."""
    home = str(Path(sys.modules["pluto_fleet"].__path__[0]).parent)
    command = respawn.library("gateway")
    assert (command[0], command[-4:]) == (sys.executable, [home, "pluto_fleet", home, "gateway"])


@pytest.mark.long
def test_a_navigation_in_an_app_s_own_package_is_found(tmp_path: Path) -> None:
    """Also where the app is not installed: the gateway looks where the app was found."""
    home = compiled(APP, tmp_path) / "src"
    own = "from wren import Wren\n\n\nclass Own(Wren):\n    pass\n"
    (home / APP / "drones.py").write_text(own, encoding="utf-8")
    (tmp_path / "fleet.toml").write_text(FLEET, encoding="utf-8")
    (tmp_path / "missions.toml").write_text(MISSIONS, encoding="utf-8")
    journal = tmp_path / "flight.journal"
    files = (tmp_path / "missions.toml", "--fleet", tmp_path / "fleet.toml", "--journal", journal)
    done = subprocess.run(
        [sys.executable, "-m", APP, "fly", *map(str, files)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join([*map(str, WRENS), *sys.path])},
        cwd=home,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, "w1 has no action measure" in done.stderr) == (2, True), done.stderr
