"""What passes a gate, and what does not."""

from __future__ import annotations

import pytest

from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import BASIC, checked, codes

S, C, F, R, U = (Status.STANDBY, Status.COMPLETED, Status.FAILED, Status.RUNNING, Status.UNEXECUTED)


def gate(kind: str, left: str, right: str) -> str:
    """A fork whose two branches bring these statuses; all that passes is taken."""
    return f"""{BASIC}
    left = MissionModifier emits {left}
    right = MissionModifier emits {right}
    gate = {kind}
    done = MissionModifier emits COMPLETED
    start -> create -> allocate -> launch -> watch -> [left, right] -> gate -> done -> end"""


@pytest.mark.parametrize(
    ("left", "right", "passes"),
    [
        ("COMPLETED", "FAILED", {F}),
        ("COMPLETED, FAILED", "STANDBY", {S, F}),
        ("UNEXECUTED, FAILED", "UNEXECUTED, STANDBY", {U, S, F}),
        ("UNEXECUTED", "COMPLETED, STANDBY", {C, S}),
        ("STANDBY", "STANDBY", {S}),
        ("RUNNING", "UNEXECUTED", {R}),
    ],
)
def test_a_gate_that_waits_for_all_passes_the_worst(
    left: str, right: str, passes: set[Status]
) -> None:
    """FAILED beats STANDBY beats COMPLETED beats RUNNING beats UNEXECUTED."""
    assert checked(gate("GateFunnel", left, right)).leaves["gate"] == passes


def test_what_cannot_be_the_worst_is_not_passed() -> None:
    """COMPLETED beside FAILED fails: an edge for COMPLETED behind the gate is never taken."""
    text = f"""{BASIC}
    good = MissionModifier emits COMPLETED
    bad = MissionModifier emits FAILED
    gate = GateFunnel
    start -> create -> allocate -> launch -> watch
    watch -> [good, bad] -> gate -> end when COMPLETED
    gate -> end when FAILED"""
    assert codes(text) == ["P2008"]


def test_the_first_to_arrive_passes_whatever_it_brings() -> None:
    """A gate for the first passes what any branch brings."""
    text = gate("GateFIFO", "UNEXECUTED, COMPLETED", "FAILED, STANDBY")
    assert checked(text).leaves["gate"] == {U, S, C, F}


def test_forks_of_different_statuses_do_not_mix_at_a_gate() -> None:
    """Each fork brings its own: FAILED of one is no excuse to lose COMPLETED of the other."""
    text = f"""{BASIC}
    one = MissionModifier
    two = MissionModifier
    gate = GateFunnel
    start -> create -> allocate -> launch -> watch -> [one, two] -> gate
    gate -> allocate when STANDBY
    gate -> end"""
    assert checked(text).leaves["gate"] == {S, C, F}


def test_a_gate_in_a_branch_gives_back_to_its_own_mission() -> None:
    """A gate shared by two forks returns to each fork what its own branches brought."""
    text = f"""{BASIC}
    one = MissionModifier
    two = MissionModifier
    gate = GateFunnel
    retry = PriorityManager
    start -> create -> [one, two] -> gate
    gate -> allocate when UNEXECUTED, STANDBY
    gate -> retry when FAILED
    gate -> end when COMPLETED
    allocate -> launch -> watch -> [one, two]
    retry -> allocate when STANDBY
    retry -> end"""
    found = checked(text)
    assert found.leaves["gate"] == {U, S, C, F}
    assert {(f.node, f.status) for f in found.forks} == {
        ("create", U),
        ("watch", S),
        ("watch", C),
        ("watch", F),
    }


def test_branches_see_the_same_end_of_a_trip() -> None:
    """One branch turns a failure into success and success into failure, the other leaves it.

    Were the two independent, COMPLETED could leave the gate. As they see one end, only FAILED can.
    """
    text = f"""{BASIC}
    timer = TimerMonitor
    well = MissionModifier emits FAILED
    badly = MissionModifier emits COMPLETED
    both = GateFunnel
    start -> create -> allocate -> launch -> [watch, timer]
    timer -> both
    watch -> well when STANDBY, COMPLETED
    watch -> badly when FAILED
    [well, badly] -> both
    both -> end"""
    assert checked(text).leaves["both"] == {Status.FAILED}
