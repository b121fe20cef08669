"""A share of the campaign: brains and gateways of real flights are killed, and nothing is lost."""

from __future__ import annotations

from pathlib import Path

from tests.kill.campaign import campaign


def test_ten_kills_lose_nothing_and_let_nothing_be_done_twice(tmp_path: Path) -> None:
    """Eight brains and two gateways, at random moments."""
    tally = campaign(tmp_path, brains=8, gateways=2, seed=3, tell=lambda _: None)
    assert tally.problems == []
    assert (tally.brains.total(), tally.gateways.total()) == (8, 2)
    assert tally.actions > 0
