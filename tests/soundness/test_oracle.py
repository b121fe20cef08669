"""The oracle itself: what it says of small apps that are known to be wrong, or to be well."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.kit.sections import Section, params, sections
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

WRONG = Path(__file__).with_name("wrong.txt")


@pytest.mark.parametrize("section", params(WRONG))
def test_oracle_sees_what_goes_wrong(section: Section) -> None:
    judged = judge(read(f"{BLOCKS}{section.given.replace('HEAD', HEAD)}\n}}"))
    assert section.comes.removeprefix("-- ") in judged.runs


def test_every_verdict_is_shown_above() -> None:
    """Else it is not known whether it can be given at all."""
    shown = {section.comes.removeprefix("-- ") for section in sections(WRONG)}
    assert shown == set(map(str, Verdict))


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
