"""`python -m tests` lists what there is, and nothing that is not there."""

from __future__ import annotations

import pytest

from tests.__main__ import CAMPAIGNS, MEASURES, REWRITES, file_of, purpose
from tests.paths import ROOT


@pytest.mark.parametrize("command", [*CAMPAIGNS, *MEASURES])
def test_every_campaign_and_measure_says_in_one_line_what_it_is_for(command: str) -> None:
    assert purpose(command).endswith((".", "?"))


@pytest.mark.parametrize("command", REWRITES)
def test_what_rewrites_is_there(command: str) -> None:
    assert file_of(command).exists()


def test_every_measure_and_every_room_that_runs_is_listed() -> None:
    listed = {file_of(command) for command in (*CAMPAIGNS, *MEASURES, *REWRITES)}
    measures = (ROOT / "benchmarks").glob("*.py")
    there = {path for path in measures if '__name__ == "__main__"' in path.read_text("utf-8")}
    for room in ("brain", "compiler", "library", "*"):
        there.update((ROOT / "tests" / room).glob("*/__main__.py"))
    assert there <= listed
