"""Hooks that misbehave in real flights under a supervisor: their missions alone notice.

`python -m tests.kill.misbehaving --times 3` flies all of it, three times.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.kill.misbehaving import TRIALS, Trial
from tests.kill.misfits import misfits_in


@pytest.fixture(scope="session")
def misfits(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app whose hooks misbehave is imported from."""
    return misfits_in(tmp_path_factory.mktemp("misfits")) / "src"


def share(trial: Trial) -> Trial:
    """Return as much of a trial as the tests have time for: two lives of it at most."""
    return replace(trial, missions=trial.missions[:1], lives=2) if trial.lives > 2 else trial


@pytest.mark.parametrize("trial", [share(trial) for trial in TRIALS], ids=lambda trial: trial.name)
def test_all_other_missions_fly_on(trial: Trial, misfits: Path, tmp_path: Path) -> None:
    """The exit code is right, reasons are given, and no process is left running."""
    assert trial.fly(misfits, tmp_path / "flight") == []
