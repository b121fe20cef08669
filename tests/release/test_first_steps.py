"""What comes first after an install or in a fresh checkout: an example to begin with, and a flown mission."""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path
from zipfile import ZipFile

from tests.kit.apps import EXAMPLES, NAMES
from tests.paths import ROOT
from tests.release.environments import run, succeed


def test_an_installed_compiler_brings_the_examples(tmp_path: Path) -> None:
    """Byte for byte, and a new app begins with one where there is no checkout."""
    wheels, there = tmp_path / "wheels", tmp_path / "there"
    succeed(sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", wheels, ROOT)
    (wheel,) = wheels.iterdir()
    with ZipFile(wheel) as packed:
        packed.extractall(there)
    for name in NAMES:
        for path in (EXAMPLES / name).glob("*.*"):
            assert (there / "plutoc/examples" / name / path.name).read_bytes() == path.read_bytes()
    # what the wheel needs is installed beside these tests; itself it comes first
    program = [sys.executable, "-P", "-m", "plutoc"]
    where = run(*program[:2], "-c", "import plutoc; print(plutoc.__file__)", PYTHONPATH=str(there))
    assert where.out.strip() == os.fspath(there / "plutoc/__init__.py")
    made = run(*program, "new", "mine", "--from", "pm10", cwd=tmp_path, PYTHONPATH=str(there))
    assert made.code == 0, made.err
    checked = run(*program, "check", "mine/mine.pluto", cwd=tmp_path, PYTHONPATH=str(there))
    assert "no errors" in checked.out, checked.err


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
