"""A block package of another author's, installed by pip, is as good as ours."""

from __future__ import annotations

import json
from pathlib import Path

from tests.paths import ROOT
from tests.release.environments import fresh, succeed

SOURCE = """\
pluto 1
use pluto_survey as survey

app grid "Survey of a grid" {
  create = MissionCreator
  spread = survey.GridScan(spacing: 150 cm, side: 3)
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor

  start -> create -> spread -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""

MISSIONS = """\
[[mission]]
name = "field"

  [[mission.trip]]
  name = "corner"
  action = "take_photo"
  target = [5.0, 5.0]
"""


def test_a_package_of_blocks_is_listed_compiled_carried_along_and_flown(tmp_path: Path) -> None:
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", ROOT, ROOT / "tests/packages/pluto_survey")
    listed = succeed(programs / "plutoc", "blocks")
    assert "pluto_survey.GridScan" in listed
    assert "spacing" in succeed(programs / "plutoc", "blocks", "pluto_survey.GridScan")
    assert "Mended" in succeed(programs / "plutoc", "explain", "P1009")  # the pages came along

    (tmp_path / "grid.pluto").write_text(SOURCE)
    (tmp_path / "missions.toml").write_text(MISSIONS)
    succeed(programs / "plutoc", "compile", "grid.pluto", cwd=tmp_path)
    carried = tmp_path / "grid/src/grid/_runtime/blocks/pluto_survey/grid_scan.py"
    assert "plutoc" not in carried.read_text()

    alone = fresh(tmp_path / "alone")
    succeed(alone / "pip", "install", "--quiet", tmp_path / "grid")
    out = succeed(alone / "grid", "simulate", tmp_path / "missions.toml", "--json")
    flown = json.loads(out)
    assert flown["trips"]["completed"] == 9
    assert flown["log"] == ["9 places to survey"]
