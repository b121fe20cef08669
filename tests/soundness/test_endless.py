"""Apps that the oracle found to go round for ever, though each of their blocks has a way out."""

from __future__ import annotations

import pytest

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
SPINNING = """
  launch -> watch
  again = MissionRepeater
  more = MissionRepeater
  [watch, again, more] -> allocate when STANDBY
  watch -> end when FAILED
  watch -> again when COMPLETED
  again -> more when COMPLETED
  more -> again when COMPLETED
"""
ENDLESS = {
    # Attempts that are used up stay so: the mission goes round where no time passes, and its app
    # hangs.
    "exhausted": ("P2010", """
  launch -> watch
  retry = PriorityManager
  watch -> allocate when STANDBY
  watch -> end when COMPLETED
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  retry -> retry when FAILED
"""),
    # Only FAILED passes such a funnel: what takes COMPLETED behind it is no way to an end.
    "a branch that always fails fails its funnel": ("P2010", """
  launch -> [mark, watch] -> all_there
  mark = MissionModifier(hook: give_up)
  all_there = GateFunnel
  all_there -> allocate when FAILED
  all_there -> end
"""),
    "what a branch has used up is used up behind its gate": ("P2010", """
  launch -> watch
  again = MissionModifier(hook: note)
  mark = MissionModifier(hook: note)
  retry = PriorityManager
  first = GateFIFO
  watch -> allocate when STANDBY
  watch -> end when COMPLETED
  watch -> again when FAILED
  again -> [retry, mark] -> first
  first -> allocate when STANDBY
  first -> again when FAILED
"""),
    # Rounds that are flown stay flown, and no time passes between the two.
    "two repeaters that lead to each other": ("P2025", SPINNING),
    # Without `emits` it may look at the mission; the repeater has no round left the next time.
    "a hook between changes nothing": (
        "P2025",
        SPINNING.replace("more = MissionRepeater", "more = MissionModifier(hook: note)").replace(
            "[watch, again, more]", "[watch, again]"
        ),
    ),
    # Nothing was flown since, so that only the hook's own FAILED would end it.
    "a verdict that is taken back is given once more": ("P2025", """
  launch -> watch
  judge = MissionEvaluator(hook: judges)
  mend = MissionModifier(hook: mends)
  [watch, judge] -> allocate when STANDBY
  watch -> end when FAILED
  watch -> judge when COMPLETED
  judge -> end when COMPLETED
  judge -> mend when FAILED
  mend -> judge when COMPLETED
  mend -> end when FAILED
"""),
}  # fmt: skip


@pytest.mark.parametrize(("code", "arrows"), ENDLESS.values(), ids=list(ENDLESS))
def test_what_has_no_way_out_is_found_by_the_oracle_and_refused(code: str, arrows: str) -> None:
    text = f"{HEAD}{arrows}}}\n"
    assert judge(read(text)).runs.keys() == {Verdict.ENDLESS}
    assert refused(text) == (code,)


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
