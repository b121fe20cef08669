"""A small share of `python -m tests.trials.campaign`: every example, struck everywhere once."""

from __future__ import annotations

import pytest

from tests.trials import campaign


def test_no_example_does_what_no_run_may_do(capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever strikes it, at every row of its journal; and everything that can strike has struck."""
    code = campaign.main(["--seeds", "1"])
    said = capsys.readouterr().out
    assert code == 0, said
    assert " 0 violations" in said


def test_an_unknown_example_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """A typing mistake tries nothing."""
    with pytest.raises(SystemExit, match="2"):
        campaign.main(["alfafa"])
    assert "no such example: alfafa" in capsys.readouterr().err
