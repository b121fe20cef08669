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


def test_each_way_round_is_looked_at_alone() -> None:
    """A clone that leaves one for a gate on another one does not pass it without the others."""
    text = f"""{HEAD}
  launch -> watch
  again = MissionRepeater
  once = MissionRepeater
  mend = MissionModifier(hook: chooses)
  all = GateFunnel
  judge = MissionEvaluator(hook: judges)
  first = GateFIFO
  watch -> allocate when STANDBY
  watch -> end when FAILED
  watch -> [once, again] when COMPLETED
  once -> all when STANDBY
  again -> mend when COMPLETED
  mend -> mend when STANDBY
  mend -> all when COMPLETED
  all -> judge when COMPLETED
  judge -> first when STANDBY, FAILED
  judge -> judge when COMPLETED
  first -> all when STANDBY, FAILED
}}
"""
    assert not judge(read(text)).sound
    assert refused(text) == ("P2009",)


def test_a_way_round_within_a_branch_may_lie_on_one_through_its_gate() -> None:
    """Who retries is behind the gate, so that the fork itself is come to again."""
    text = f"""{HEAD}
  launch -> watch
  retry = PriorityManager
  fork = MissionModifier(hook: note)
  mend = MissionModifier(hook: mends)
  again = MissionRepeater
  beside = MissionModifier(hook: chooses)
  first = GateFIFO
  [watch, retry, first] -> allocate when STANDBY
  watch -> end when COMPLETED
  [watch, first] -> retry when FAILED
  retry -> fork when FAILED
  fork -> [mend, beside]
  mend -> again when COMPLETED
  again -> mend when COMPLETED, STANDBY
  mend -> first when FAILED
  beside -> first
  first -> end when COMPLETED
}}
"""
    assert refused(text) == ("P2025",)
