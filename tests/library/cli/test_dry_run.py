"""`fly --dry-run` reaches no drone; what it prints is in sessions."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.library.cli.conftest import Command
from tests.library.cli.fake_drones import RECORD


@pytest.fixture(autouse=True)
def _nothing_is_done(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Let all that would be written by default be written where it can be seen."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    RECORD.clear()


def test_no_drone_is_reached_and_nothing_is_written(command: Command, tmp_path: Path) -> None:
    """The fleet's navigation is not even made, and there is no journal."""
    shutil.copytree(Path(__file__).parent / "sessions" / "dry_run", tmp_path / "plan")
    plan = [tmp_path / "plan/m.toml", "--fleet", tmp_path / "plan/f.toml"]
    before = sorted(tmp_path.rglob("*"))
    assert command("fly", *plan, "--dry-run")[0] == 0
    assert RECORD == []
    assert sorted(tmp_path.rglob("*")) == before
