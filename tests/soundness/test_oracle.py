"""The oracle itself: what it says of small apps that are known to be wrong, or to be well."""

from __future__ import annotations

import pytest

from tests.soundness.app import read
from tests.soundness.oracle import judge
from tests.soundness.state import Verdict
from tests.soundness.thesis import thesis_graphs

BLOCKS = """pluto 1
app small {
  modifier note
  modifier pretend emits RUNNING
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  timer = TimerMonitor
  mark = MissionModifier(hook: note)
  still = MissionModifier(hook: pretend)
  one = GateFIFO
  two = GateFunnel
"""
HEAD = "start -> create -> allocate -> launch"

WRONG = {
    "a status that no arrow takes": (Verdict.STUCK, f"""{HEAD} -> watch
            watch -> end"""),
    "a funnel that waits for a branch which goes round": (Verdict.DEADLOCKED, f"""{HEAD} -> [watch, mark]
            mark -> mark
            watch -> two
            two -> allocate when STANDBY
            two -> end"""),
    "branches at different funnels": (Verdict.DEADLOCKED, f"""{HEAD} -> [watch, timer]
            watch -> two
            timer -> other
            other = GateFunnel
            [two, other] -> allocate when STANDBY
            [two, other] -> end"""),
    "two monitors and no gate": (Verdict.FLOWN_TWICE, f"""{HEAD} -> [watch, timer]
            [watch, timer] -> allocate when STANDBY
            [watch, timer] -> end"""),
    "a branch that ends": (Verdict.LOST, f"""{HEAD} -> [watch, timer]
            watch -> one
            timer -> one when STANDBY, FAILED
            one -> allocate when STANDBY
            one -> end"""),
    "a gate without a fork": (Verdict.LOST, f"""{HEAD} -> watch -> one
            one -> allocate when STANDBY
            one -> end"""),
    "a launch without a drone": (Verdict.NO_DRONE, f"""{HEAD} -> watch
            watch -> launch when STANDBY
            watch -> end"""),
    "a monitor without a launch": (Verdict.NO_LAUNCH, """start -> create -> still -> watch
            watch -> end"""),
    "no arrow to an end": (Verdict.ENDLESS, f"""{HEAD} -> still -> still"""),
    "a fork that comes round to itself": (Verdict.BREEDS, f"""{HEAD} -> mark -> [mark, watch]
            watch -> end"""),
    "a branch that only the gate calls off": (Verdict.UNCLOSED, f"""{HEAD} -> [watch, mark]
            mark -> mark
            watch -> one
            one -> allocate when STANDBY
            one -> end"""),
}  # fmt: skip


@pytest.mark.parametrize("verdict, arrows", WRONG.values(), ids=list(WRONG))
def test_oracle_sees_what_goes_wrong(verdict: Verdict, arrows: str) -> None:
    assert verdict in judge(read(f"{BLOCKS}{arrows}\n}}")).runs


def test_every_verdict_is_shown_above() -> None:
    """Else it is not known whether it can be given at all."""
    assert {verdict for verdict, _ in WRONG.values()} == set(Verdict)


def test_run_tells_step_by_step_how_it_comes_to_that() -> None:
    text = thesis_graphs()["basic"].text.replace(" when STANDBY", " when FAILED")
    assert judge(read(text)).runs[Verdict.STUCK] == (
        "2 trips",
        "create UNEXECUTED",
        "allocate UNEXECUTED",
        "launch RUNNING",
        "the trip ends STANDBY",
        "watch STANDBY: stuck at watch",
    )


def test_branches_see_one_outcome() -> None:
    """Both monitors end alike, so the gate never holds one that failed and one that did not."""
    app = read(f"""{BLOCKS}
        {HEAD} -> [watch, timer]
        watch -> one when FAILED
        timer -> one when FAILED
        watch -> two when STANDBY, COMPLETED
        timer -> two when STANDBY, COMPLETED
        [one, two] -> allocate when STANDBY
        [one, two] -> end
        }}""")
    judgement = judge(app)
    assert judgement.runs == {}
    assert "launch RUNNING closes at one, two" in judgement.faults


def test_dead_blocks_and_arrows_are_those_that_no_run_comes_to() -> None:
    text = thesis_graphs()["basic"].text.replace("}\n", "  watch -> launch when UNEXECUTED\n}\n")
    assert judge(read(text)).faults == ("nothing takes watch -> launch when UNEXECUTED",)
