"""A gateway is not started by hand: a person who tries is told so."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.gateway.process import main


@pytest.mark.parametrize("arguments", [[], ["--help"], ["a", "b"]])
def test_starting_it_by_hand_is_answered_that_apps_do(
    arguments: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """And nothing is left in the folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "--help").mkdir()
    assert main(arguments) == 2
    assert "an app starts this by itself" in capsys.readouterr().err
    assert not list((tmp_path / "--help").iterdir())
