"""The page on navigation shows what there is, and the navigation of forty lines that it shows passes the kit."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from math import pi
from pathlib import Path

import pytest
from wren import Wren

import pluto_fleet
from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import DroneNavigation, DroneSetup
from tests.paths import ROOT

DOCS = ROOT / "docs"
PAGE = (DOCS / "navigation.md").read_text()


BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize(("name", "place"), [("wren", 0), ("lines", 1), ("bodies", 2)])
def test_the_page_shows_the_files_as_they_are(name: str, place: int, update: bool) -> None:
    text = (DOCS / f"navigation/{name}.py").read_text()
    code = text.partition("from __future__ import annotations\n\n")[2]
    page = (DOCS / "navigation.md").read_text()
    shown = BLOCK.findall(page)[place]
    if update:
        (DOCS / "navigation.md").write_text(page.replace(shown, code))
    else:
        assert shown == code


@pytest.mark.long
def test_the_test_file_that_the_page_shows_is_one(tmp_path: Path) -> None:
    """As its reader runs it: with pytest, and nothing of ours besides."""
    (tmp_path / "test_wren.py").write_text(BLOCK.findall(PAGE)[3])
    runtime = Path(pluto_fleet.__path__[0]).parent
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-k", "go_to_is_refused or falls_silent", "-rs"],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(map(str, [DOCS / "navigation", runtime])),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert "1 passed, 1 skipped" in done.stdout, done.stdout + done.stderr
    assert "silence is not given" in done.stdout


@pytest.mark.long
class TestWren(NavigationContract):
    height, speed, away, rest = 0.4, 1.0, 1.0, 0.2
    may_fall = together = True

    def make(self) -> DroneNavigation:
        return self.wren("wren:100,50")

    def make_unreachable(self) -> DroneNavigation:
        return self.wren("sparrow")

    def wren(self, uri: str) -> Wren:
        home = (1.0, 0.5, 0.0)
        return Wren(DroneSetup(id="w1", uri=uri, home=home, speed=1.0, options={}, folder=Path()))

    def silence(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Wren)
        navigation.radio.silent = True

    def crash(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Wren)
        navigation.radio.send("off")

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        assert isinstance(navigation, Wren)
        if (at := navigation.radio.at) is None:
            return None
        x, y, z = at
        turning = navigation.radio.mode in ("moving", "hovering")
        return Truth(position=(x / 100, y / 100, z / 100), yaw=pi / 2, motors=turning)
