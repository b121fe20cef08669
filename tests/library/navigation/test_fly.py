"""An app flies drones of a class of one's own, named in the fleet file, in processes of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pluto_fleet
from tests.kill.trial import end_gateway
from tests.kit.apps import compiled
from tests.library.navigation.test_loading import offered
from tests.paths import ROOT

DOCS = ROOT / "docs/navigation"
MISSIONS = """
[[mission]]
name = "field"
evaluator = "find_blooms"
[[mission.trip]]
name = "near"
action = "pollinate"
target = [1.5, 1.0]
parameters = { dose = "10 mg" }
[[mission.trip]]
name = "far"
action = "pollinate"
target = [3.5, 1.0]
parameters = { dose = "10 mg" }
"""
FLEET = """
[map]
size = [6.0, 6.0]
cruise_height = 0.5
[fleet]
navigation = "wren:Wren"
[[drone]]
id = "w1"
category = "carrier"
home = [1.0, 0.5]
uri = "wren:100,50"
"""
OFFERED = """
[[drone]]
id = "w2"
category = "carrier"
home = [3.0, 0.5]
uri = "wren:300,50"
navigation = "wren"
"""
"""A drone that is flown by what an installed package offers."""


def fly(folder: Path, fleet: str) -> subprocess.CompletedProcess[str]:
    """Fly the missions with this fleet, to the end."""
    source = compiled("alfalfa", folder / "package") / "src"
    (folder / "missions.toml").write_text(MISSIONS)
    (folder / "fleet.toml").write_text(fleet)
    offered(folder, "pluto-wren", "plutoc.navigations", "wren = wren:Wren")
    runtime = Path(pluto_fleet.__path__[0]).parent
    words = ["fly", "missions.toml", "--fleet", "fleet.toml", "--journal", "flight.journal"]
    try:
        return subprocess.run(
            [sys.executable, "-m", "alfalfa", *words],
            cwd=folder,
            env={
                **os.environ,
                "PYTHONPATH": os.pathsep.join(map(str, [source, DOCS, runtime, folder])),
                "XDG_STATE_HOME": str(folder / "state"),
            },
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
    finally:
        end_gateway(folder / "flight.journal")


def test_the_navigation_of_forty_lines_flies_an_app(tmp_path: Path) -> None:
    """By its class for one drone, and for the other as what a package offers."""
    done = fly(tmp_path, FLEET + OFFERED)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "trip near completed (w1)" in done.stdout
    assert "trip far completed (w2)" in done.stdout
    assert "1 of 1 mission completed" in done.stdout


def test_a_class_that_is_not_there_is_refused_before_anything_begins(tmp_path: Path) -> None:
    done = fly(tmp_path, FLEET.replace("wren:Wren", "wren:Robin"))
    assert done.returncode == 2
    assert 'its module has no class "Robin"' in done.stderr
    assert not (tmp_path / "flight.journal").exists()


def test_a_drone_that_cannot_be_made_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    done = fly(tmp_path, FLEET.replace("wren:100,50", "wren:here"))
    assert done.returncode == 2
    assert "could not be made for w1: ValueError" in done.stderr
    assert not (tmp_path / "flight.journal").exists()
    assert "Traceback" not in done.stderr


def test_a_module_that_ends_its_importing_process_does_not_end_the_app(tmp_path: Path) -> None:
    """Not with an exit code that says that all was flown."""
    (tmp_path / "leaving.py").write_text(
        "import os; os._exit(0)\nclass Wren:\n    async def connect(self): ..."
    )
    done = fly(tmp_path, FLEET.replace("wren:Wren", "leaving:Wren"))
    assert done.returncode == 2
    assert '"leaving" ends the process that imports it (exit code 0)' in done.stderr
    assert not (tmp_path / "flight.journal").exists()


def test_drones_that_cannot_hear_where_they_are_are_refused(tmp_path: Path) -> None:
    fleet = FLEET.replace('"wren:Wren"', '"wren:Wren"\nlocalization = "lines:Lines"')
    done = fly(tmp_path, fleet)
    assert done.returncode == 2
    assert "w1 cannot be told where they are" in done.stderr
    assert not (tmp_path / "flight.journal").exists()
