"""Apps that the oracle found to go round for ever, though each of their blocks has a way out."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.kit.sections import Section, params
from tests.soundness.app import read
from tests.soundness.compare import refused
from tests.soundness.oracle import judge
from tests.soundness.state import Verdict

HEAD = """pluto 1
app endless {
  modifier note
  modifier give_up emits FAILED
  modifier mends emits COMPLETED, FAILED
  modifier chooses emits STANDBY, COMPLETED, FAILED
  evaluator judges
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch
"""
ENDLESS = Path(__file__).with_name("endless.txt")


@pytest.mark.parametrize("section", params(ENDLESS))
def test_what_has_no_way_out_is_found_by_the_oracle_and_refused(section: Section) -> None:
    text = f"{HEAD}{section.given}\n}}\n"
    assert judge(read(text)).runs.keys() == {Verdict.ENDLESS}
    assert refused(text) == (section.comes.removeprefix("-- "),)


@pytest.mark.parametrize("section", params(Path(__file__).with_name("round.txt")))
def test_a_way_round_in_a_branch_is_refused(section: Section) -> None:
    assert refused(f"{HEAD}{section.given}\n}}\n") == (section.comes.removeprefix("-- "),)
