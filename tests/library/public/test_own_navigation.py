"""An app flies drones of a class of one's own, named in the fleet file, in processes of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import pluto_fleet
from tests.kill.trial import end_gateway
from tests.kit.apps import compiled
from tests.library.drones.test_loading import Installed
from tests.paths import ROOT

pytestmark = pytest.mark.long

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
    Installed(folder).offers("pluto-wren", "plutoc.navigations", "wren = wren:Wren")
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


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("wren:Wren", "wren:Robin", 'its module has no class "Robin"'),
        ("wren:100,50", "wren:here", "could not be made for w1: ValueError"),
        ("wren:Wren", "leaving:Wren", "cannot be imported: SystemExit: 0"),
        (
            '"wren:Wren"',
            '"wren:Wren"\nlocalization = "lines:Lines"',
            "w1 cannot be told where they are",
        ),
    ],
)
def test_what_cannot_fly_is_refused_before_anything_is_written(
    tmp_path: Path, old: str, new: str, why: str
) -> None:
    """A module that ends its process does not end the app with an exit code that says all was flown."""
    (tmp_path / "leaving.py").write_text(
        "import sys; sys.exit(0)\nclass Wren:\n    async def connect(self): ..."
    )
    done = fly(tmp_path, FLEET.replace(old, new))
    assert done.returncode == 2
    assert why in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "flight.journal").exists()
