"""The campaign of `python -m tests.campaign`, small."""

from __future__ import annotations

import pytest

from tests import campaign


def test_campaign_counts_every_run(capsys: pytest.CaptureFixture[str]) -> None:
    """Two seeds of one example are two runs, and a table of one line."""
    assert campaign.main(["warehouse_item_finder", "--seeds", "2", "--fail", "crash=0%"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == ["warehouse_item_finder", "2", "12", "12", "0", "24", "0", "0"]
    assert lines[-1].startswith("2 runs in ") and lines[-1].endswith(" s, 0 violations")


def test_campaign_says_which_seed_is_broken(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A violation is named with its seed, and ends the campaign with 1."""
    monkeypatch.setattr(campaign, "violations", lambda trace, items: ["a mission hangs"])
    assert campaign.main(["drugs_distribution", "--seeds", "1", "--first", "41"]) == 1
    assert "drugs_distribution, seed 41: a mission hangs" in capsys.readouterr().out


def test_campaign_refuses_an_unknown_example(capsys: pytest.CaptureFixture[str]) -> None:
    """A typing mistake flies nothing."""
    with pytest.raises(SystemExit, match="2"):
        campaign.main(["alfafa"])
    assert "no such example: alfafa" in capsys.readouterr().err
