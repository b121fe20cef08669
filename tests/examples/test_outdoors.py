"""The examples that people fly outdoors: with other files, and vehicles that speak MAVLink, the same apps."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from pluto_fleet.cli import main as fleet_main
from tests.kit.apps import EXAMPLES, example
from tests.kit.command import run

NAMES = ("aerial_mapping", "alfalfa", "pm10", "pursue")
FILES = ("outdoors_missions.toml", "--fleet", "outdoors.toml")
MINUTES = 9


@pytest.mark.parametrize("name", NAMES)
def test_the_same_app_completes_on_a_field(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is warned of, and each mission is completed."""
    monkeypatch.chdir(EXAMPLES / name)
    checked = run(partial(fleet_main, example(name).app), "check", *FILES)
    assert (checked.code, checked.err) == (0, "")
    assert "warning" not in checked.out
    ran = run(partial(fleet_main, example(name).app), "simulate", *FILES)
    assert ran.code == 0, ran.out + ran.err
    completed = re.search(r"(\d+) of (\d+) missions completed", ran.out)
    assert completed is not None
    assert completed[1] == completed[2]


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("make", ["px4", "ardupilot"])
def test_simulated_autopilots_fly_it(make: str, tmp_path: Path) -> None:
    """Through MAVSDK, in real time, with photos on the way by what their cameras tell."""
    pytest.importorskip("mavsdk")
    one = example("aerial_mapping")
    fleet = (EXAMPLES / one.name / "outdoors.toml").read_text(encoding="utf-8")
    options = f'\n[navigation.mavlink]\nautopilot = "{make}"\n\n[[drone]]'
    (tmp_path / "outdoors.toml").write_text(fleet.replace("\n[[drone]]", options, 1))
    missions = EXAMPLES / one.name / FILES[0]
    words = ("fly", missions, *FILES[1:], "--mavlink-sim", "2", "--journal", "flown.journal")
    ran = subprocess.run(
        [sys.executable, "-m", one.name, *words],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(one.package / "src")},
        capture_output=True,
        text=True,
        timeout=60 * MINUTES,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "4 of 4 missions completed" in ran.stdout
