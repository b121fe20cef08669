"""Graphs that must pass: the thesis's, and shapes that look like mistakes but are none."""

from __future__ import annotations

import pytest

from plutoc_runtime.domain.status import Status
from tests.compiler.check.graphs import BASIC, GATED, checked, codes, findings

RETRY = """
    retry = PriorityManager
    first -> retry when FAILED
    retry -> allocate when STANDBY
    retry -> end otherwise
"""
ALFALFA = """
    create = MissionCreator
    wait = Clock
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    timer = TimerMonitor
    first = GateFIFO
    judge = MissionEvaluator
    again = MissionRepeater
    retry = PriorityManager(max_attempts: 3)

    start -> create -> wait -> allocate -> launch -> [watch, timer] -> first
    first -> allocate when STANDBY
    first -> retry when FAILED
    first -> judge when COMPLETED
    retry -> allocate when STANDBY
    judge -> allocate when STANDBY
    judge -> again when COMPLETED
    again -> allocate when STANDBY
    again -> end when COMPLETED
    judge -> end otherwise
    retry -> end otherwise
"""
SOUND = {
    "alfalfa": ALFALFA,
    "figure 6.12, the basic graph": f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end""",
    "figure 6.12, without any guard": f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate
    watch -> end""",
    "figure 6.13, failed trips once more": f"""{BASIC}
    retry = PriorityManager
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> retry -> allocate when STANDBY
    watch -> end
    retry -> end""",
    "figure 6.14, a delay before each trip": f"""{BASIC}
    retry = PriorityManager
    wait = Clock
    start -> create -> wait -> allocate -> launch -> watch
    watch -> wait when STANDBY
    watch -> retry
    retry -> allocate when STANDBY
    watch -> end
    retry -> end""",
    "figure 6.15, a timer of the developer's own": f"""{BASIC}
    limit = MissionModifier emits STANDBY, COMPLETED, FAILED
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, limit] -> first
    first -> allocate when STANDBY
    first -> end""",
    "a gate that waits for all": f"""{GATED.replace("GateFIFO", "GateFunnel")}
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "branches that are chains": f"""{BASIC}
    timer = TimerMonitor
    note = MissionModifier
    mark = MissionModifier
    first = GateFIFO
    start -> create -> allocate -> launch -> watch -> note -> mark -> first
    launch -> timer -> first
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "a branch that routes inside": f"""{BASIC}
    timer = TimerMonitor
    good = MissionModifier
    bad = MissionModifier
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer]
    watch -> good when COMPLETED, STANDBY
    watch -> bad when FAILED
    [good, bad, timer] -> first
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "a fork in a branch of a fork": f"""{BASIC}
    timer = TimerMonitor
    left = MissionModifier
    right = MissionModifier
    both = GateFunnel
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer]
    watch -> [left, right] -> both -> first
    timer -> first
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "a limit beside a monitor that stands in a deeper fork": f"""{BASIC}
    timer = TimerMonitor
    gap = GapMonitor
    inner = GateFIFO
    first = GateFIFO
    begin = MissionModifier
    start -> create -> allocate -> launch -> [begin, timer]
    begin -> [watch, gap] -> inner -> first
    timer -> first
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "a gate that forks at once": f"""{BASIC}
    timer = TimerMonitor
    first = GateFIFO
    left = MissionModifier
    right = MissionModifier
    both = GateFunnel
    start -> create -> allocate -> launch -> [watch, timer] -> first
    first -> [left, right] when STANDBY
    [left, right] -> both -> allocate
    first -> end when COMPLETED {RETRY}""",
    "a fork before the first launch": f"""{BASIC}
    left = MissionModifier
    right = MissionModifier
    both = GateFunnel
    retry = PriorityManager
    start -> create -> [left, right] -> both -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> retry when FAILED
    watch -> end
    retry -> allocate when STANDBY
    retry -> end""",
    "one gate that closes two forks in turn": f"""{BASIC}
    retry = PriorityManager
    left = MissionModifier
    right = MissionModifier
    both = GateFunnel
    start -> create -> [left, right] -> both
    both -> allocate when UNEXECUTED, STANDBY
    allocate -> launch -> watch -> [left, right] when STANDBY
    watch -> retry when FAILED
    watch -> end
    retry -> allocate when STANDBY
    retry -> end""",
    "a loop inside a branch that has a way out": f"""{BASIC}
    timer = TimerMonitor
    tune = MissionModifier emits COMPLETED, STANDBY
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer]
    watch -> first when STANDBY, FAILED
    watch -> tune when COMPLETED
    tune -> tune when STANDBY
    tune -> first when COMPLETED
    timer -> first
    first -> allocate when STANDBY
    first -> end when COMPLETED {RETRY}""",
    "a failed mission that an allocator lets in": f"""{BASIC}
    judge = MissionEvaluator
    retry = PriorityManager
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> retry when FAILED
    watch -> judge when COMPLETED
    retry -> allocate when STANDBY
    judge -> allocate when STANDBY
    judge -> end
    retry -> end""",
}


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_graph_is_not_reported(name: str) -> None:
    """Nothing is an error; only that nothing retries may be mentioned."""
    found = [d for d in findings(SOUND[name]) if d.code != "P2055"]
    assert [f"{d.code}: {d.message}" for d in found] == []


def test_the_sample_of_the_language_has_no_warning_at_all() -> None:
    """The sample that is read first compiles in silence."""
    assert codes(ALFALFA) == []


def test_a_fork_is_found_with_its_branches_and_its_gate() -> None:
    """Branches stand in the order of the source, and the gate is named."""
    (fork,) = checked(ALFALFA).forks
    assert (fork.node, fork.status, fork.gate) == ("launch", Status.RUNNING, "first")
    assert [edge.target for edge in fork.branches] == ["watch", "timer"]


def test_nested_forks_have_gates_of_their_own() -> None:
    """The fork inside closes at the gate inside."""
    forks = checked(SOUND["a fork in a branch of a fork"]).forks
    assert {(fork.node, fork.gate) for fork in forks} == {("launch", "first"), ("watch", "both")}
    assert [f.status for f in forks if f.node == "watch"] == [
        Status.STANDBY,
        Status.COMPLETED,
        Status.FAILED,
    ]


def test_statuses_are_known_on_every_edge() -> None:
    """An edge carries what really passes, not what it could take."""
    carries = {(e.source, e.target): s for e, s in checked(ALFALFA).carries.items()}
    assert carries["start", "create"] == {Status.UNEXECUTED}
    assert carries["wait", "allocate"] == {Status.UNEXECUTED}
    assert carries["allocate", "launch"] == {Status.UNEXECUTED, Status.STANDBY}
    assert carries["launch", "timer"] == {Status.RUNNING}
    assert carries["judge", "end"] == {Status.FAILED}


def test_where_missions_end_without_saying_so_is_kept() -> None:
    """The plan needs implicit ends as much as written ones."""
    text = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY
    watch -> end when COMPLETED"""
    assert checked(text).implicit_ends == (("watch", Status.FAILED),)
    assert codes(text) == ["P2051", "P2055"]
