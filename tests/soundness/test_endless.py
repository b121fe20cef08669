"""Apps that the oracle found to go round for ever, though each of their blocks has a way out."""

from __future__ import annotations

import pytest

from tests.soundness.app import read
from tests.soundness.compare import refused
from tests.soundness.oracle import judge
from tests.soundness.state import Verdict

EXHAUSTED = """pluto 1
app exhausted {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end when COMPLETED
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  retry -> retry when FAILED
}
"""
ALWAYS_WORST = """pluto 1
app always_worst {
  modifier give_up emits FAILED
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  mark = MissionModifier(hook: give_up)
  all_there = GateFunnel
  start -> create -> allocate -> launch -> [mark, watch] -> all_there
  all_there -> allocate when FAILED
  all_there -> end
}
"""
EXHAUSTED_BESIDE = """pluto 1
app exhausted_beside {
  modifier note
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  again = MissionModifier(hook: note)
  mark = MissionModifier(hook: note)
  retry = PriorityManager
  first = GateFIFO
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end when COMPLETED
  watch -> again when FAILED
  again -> [retry, mark] -> first
  first -> allocate when STANDBY
  first -> again when FAILED
}
"""


@pytest.mark.parametrize(
    "text",
    [EXHAUSTED, ALWAYS_WORST, EXHAUSTED_BESIDE],
    ids=["exhausted", "always_worst", "exhausted_beside"],
)
def test_oracle_finds_no_way_out(text: str) -> None:
    assert judge(read(text)).runs.keys() == {Verdict.ENDLESS}


def test_attempts_that_are_used_up_stay_used_up() -> None:
    """Otherwise the mission goes round where no time passes, and its app hangs."""
    assert "P2010" in refused(EXHAUSTED)


def test_what_a_branch_has_used_up_is_used_up_behind_its_gate() -> None:
    assert "P2010" in refused(EXHAUSTED_BESIDE)


def test_branch_that_always_fails_fails_its_funnel() -> None:
    """Only FAILED passes such a funnel, so what takes COMPLETED behind it is no way to an end."""
    assert "P2010" in refused(ALWAYS_WORST)


SPINNING = """pluto 1
app spinning {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  again = MissionRepeater
  more = MissionRepeater
  start -> create -> allocate -> launch -> watch
  [watch, again, more] -> allocate when STANDBY
  watch -> end when FAILED
  watch -> again when COMPLETED
  again -> more when COMPLETED
  more -> again when COMPLETED
}
"""


def test_rounds_that_are_flown_stay_flown() -> None:
    """Two repeaters that lead to each other: no time passes between them."""
    assert judge(read(SPINNING)).runs.keys() == {Verdict.ENDLESS}
    assert "P2025" in refused(SPINNING)


def test_a_hook_between_changes_nothing() -> None:
    """Without `emits` it may look at the mission; the repeater has no round left the next time."""
    noted = SPINNING.replace("more = MissionRepeater", "more = MissionModifier(hook: note)")
    noted = noted.replace("app spinning {", "app spinning {\n  modifier note")
    noted = noted.replace("[watch, again, more]", "[watch, again]")
    assert judge(read(noted)).runs.keys() == {Verdict.ENDLESS}
    assert "P2025" in refused(noted)


OVERRULED = """pluto 1
app overruled {
  modifier mends emits COMPLETED, FAILED
  evaluator judges
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: judges)
  mend = MissionModifier(hook: mends)
  start -> create -> allocate -> launch -> watch
  [watch, judge] -> allocate when STANDBY
  watch -> end when FAILED
  watch -> judge when COMPLETED
  judge -> end when COMPLETED
  judge -> mend when FAILED
  mend -> judge when COMPLETED
  mend -> end when FAILED
}
"""


def test_a_verdict_that_is_taken_back_is_given_once_more() -> None:
    """Nothing was flown since, so that only the hook's own FAILED would end it."""
    assert judge(read(OVERRULED)).runs.keys() == {Verdict.ENDLESS}
    assert refused(OVERRULED) == ("P2025",)


ALONE = """pluto 1
app alone {
  modifier more emits STANDBY, COMPLETED, FAILED
  evaluator judges
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  again = MissionRepeater
  once = MissionRepeater
  mend = MissionModifier(hook: more)
  all = GateFunnel
  judge = MissionEvaluator(hook: judges)
  first = GateFIFO
  start -> create -> allocate -> launch -> watch
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
}
"""


def test_each_way_round_is_looked_at_alone() -> None:
    """A clone that leaves one for a gate on another one does not pass it without the others."""
    assert not judge(read(ALONE)).sound
    assert "P2009" in refused(ALONE)


def test_a_way_round_within_a_branch_may_lie_on_one_through_its_gate() -> None:
    """Who retries is behind the gate, so that the fork itself is come to again."""
    text = """pluto 1
app within {
  modifier mends emits COMPLETED, FAILED
  modifier chooses emits STANDBY, COMPLETED, FAILED
  modifier note
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager
  fork = MissionModifier(hook: note)
  mend = MissionModifier(hook: mends)
  again = MissionRepeater
  beside = MissionModifier(hook: chooses)
  first = GateFIFO
  start -> create -> allocate -> launch -> watch
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
}
"""
    assert refused(text) == ("P2025",)
