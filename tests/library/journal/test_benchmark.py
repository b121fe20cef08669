"""What a journal costs can be measured; how much that is, is not tested here."""

from __future__ import annotations

import json

import pytest

import journal


def test_a_journal_is_measured(capsys: pytest.CaptureFixture[str]) -> None:
    journal.main(["--missions", "3", "--rounds", "1", "--seconds", "0.02", "--json"])
    told = json.loads(capsys.readouterr().out)
    assert list(told) == [
        *(f"rows a second, in groups of {group}" for group in journal.GROUPS),
        "transitions a second",
        "seconds by all rows",
        "of CPU, by all rows",
        "of CPU, to make a snapshot",
        "seconds from a snapshot",
        "of CPU, from a snapshot",
    ]
    assert all(number > 0 for number in told.values())
