"""The README's first command, in a folder with nothing but the sources, flies missions."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from tests.paths import ROOT
from tests.release.environments import succeed

NOT_SOURCES = shutil.ignore_patterns(".*_cache", ".git", ".hypothesis", ".venv", "__pycache__")


def test_the_readmes_first_command_ends_with_a_flown_mission_on_the_screen(
    tmp_path: Path,
) -> None:
    checkout = tmp_path / "checkout"
    shutil.copytree(ROOT, checkout, ignore=NOT_SOURCES)
    readme = (ROOT / "README.md").read_text()
    commands = re.findall(r"^```\n(python3 .*)\n```$", readme, re.MULTILINE)
    out = succeed("bash", "-c", commands[0], cwd=checkout)
    assert "Mission 3: COMPLETED" in out
    assert "3 of 3 missions completed" in out.splitlines()[-2]
