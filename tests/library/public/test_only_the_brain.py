"""Of an app the library imports its brain, and nothing else, from the first instant of a flight to the last.

Nothing but what the app carries can be imported as a brain: `watched/sitecustomize.py` sees to that.
"""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.kit.apps import compiled_file

HERE = Path(__file__).parent
NAME = "watered_garden"
SOURCE = HERE / NAME
"""An app with a hook of each kind that takes part in a mission."""
PLAN = (str(SOURCE / "missions.toml"), "--fleet", str(SOURCE / "fleet.toml"))
POURS = "pours on"
"""What its action says in the middle of a flight."""

pytestmark = pytest.mark.process


class Program:
    """The app's own program."""

    def __init__(self, package: Path) -> None:
        self._imports = package / "imports.txt"
        paths = os.pathsep.join((str(package / "src"), str(HERE / "watched")))
        self.environment = {
            **os.environ,
            "PYTHONPATH": paths,
            "PLUTO_IMPORTS": str(self._imports),
        }

    @property
    def imported(self) -> set[str]:
        """Which modules of the app's brain the library has imported, and where."""
        return set(self._imports.read_text(encoding="utf-8").splitlines())

    def begun(self, *words: str) -> subprocess.Popen[str]:
        """Begin a command."""
        return subprocess.Popen(
            [sys.executable, "-m", *words],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def said(self, *words: str, code: int = 0) -> str:
        """Run a command to its end, and return what it printed."""
        process = self.begun(*words)
        out, err = process.communicate()
        assert process.returncode == code, err
        return out


@pytest.fixture
def program(tmp_path: Path) -> Program:
    return Program(compiled_file(SOURCE / "app.pluto", tmp_path / NAME))


ONLY_THE_BRAIN = {f"pluto_fleet.app {NAME}._runtime.brain"}


def test_it_flies(program: Program, tmp_path: Path) -> None:
    journal = str(tmp_path / "flight.journal")
    said = program.said(NAME, "fly", *PLAN, "--sim", "--speed", "200", "--journal", journal)
    assert POURS in said
    assert "2 of 2 missions completed" in said.splitlines()[-1]
    assert program.imported == ONLY_THE_BRAIN


@pytest.mark.long
def test_it_is_tried(program: Program) -> None:
    """By `plutoc test`, which kills it at every instant."""
    program.said("pluto_fleet.trials", NAME, "--seeds", "1")
    assert program.imported == ONLY_THE_BRAIN


@pytest.mark.long
@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL])
def test_an_action_that_was_cut_short_is_decided_on(
    program: Program, end: signal.Signals, tmp_path: Path
) -> None:
    """Water is not poured twice by itself: a person says that none was, and the rest is flown."""
    journal = str(tmp_path / "flight.journal")
    words = ("fly", *PLAN, "--sim", "--speed", "50", "--journal", journal)
    with program.begun(NAME, *words) as flying:
        assert flying.stdout is not None
        next(line for line in flying.stdout if POURS in line)
        flying.send_signal(end)
    asked = program.said(NAME, "resume", journal, code=4)
    (answer,) = [line for line in asked.splitlines() if line.endswith(" not-done")]
    _, *decision = shlex.split(answer)
    program.said(NAME, *decision)
    resumed = program.said(NAME, "resume", journal)
    assert "2 of 2 missions completed" in resumed.splitlines()[-1]
    assert "COMPLETED" in program.said(NAME, "journal", journal)
    assert program.imported == ONLY_THE_BRAIN
