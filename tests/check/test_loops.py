"""Loops on which nothing is flown: those that are well, and how long one looks at tangled ones."""

from __future__ import annotations

import pytest

from plutoc.check import statuses
from plutoc.diagnostic import Severity
from tests.check.graphs import findings
from tests.check.test_mistakes import BRANCHED, FLOWN, JUDGED, REPEATED

LEFT = {
    "a repeater whose way back a hook may leave with more trips": (
        f"{REPEATED}    more = MissionModifier emits STANDBY, COMPLETED\n"
        "    again -> more when COMPLETED\n    more -> again when COMPLETED\n"
        "    more -> allocate when STANDBY"
    ),
    "a modifier that looks, and leads to the end": (
        f"{REPEATED}    look = MissionModifier\n    again -> look when COMPLETED\n    look -> end"
    ),
    "a hook that fails a mission on its way to the end": (
        f"{REPEATED}    mend = MissionModifier emits COMPLETED, FAILED\n"
        "    again -> mend when COMPLETED\n    mend -> end"
    ),
    "judged, repeated, and judged once more": (
        f"{JUDGED}    again = MissionRepeater\n    last = MissionEvaluator\n"
        "    judge -> again when COMPLETED\n    again -> allocate when STANDBY\n"
        "    again -> last when COMPLETED\n    last -> allocate when STANDBY\n    last -> end"
    ),
    "a repeater in a branch": f"{BRANCHED}    again -> all when COMPLETED",
    "a failed mission is let into the allocator that flies the others": (
        f"{JUDGED}    judge -> end when COMPLETED"
    ).replace("judge -> end when FAILED", "judge -> allocate when FAILED"),
    "a retry that takes what failed in flight, and what was judged": (
        f"{JUDGED}    judge -> end when COMPLETED\n    retry = PriorityManager\n"
        "    retry -> allocate when STANDBY\n    retry -> end"
    )
    .replace("watch -> end when FAILED", "watch -> retry when FAILED")
    .replace("judge -> end when FAILED", "judge -> retry when FAILED"),
}


def errors(text: str) -> list[str]:
    return [found.code for found in findings(text) if found.severity is Severity.ERROR]


@pytest.mark.parametrize("text", LEFT.values(), ids=list(LEFT))
def test_a_loop_that_can_be_left_is_no_mistake(text: str) -> None:
    assert errors(text) == []


def test_there_is_a_bound_of_states_and_it_is_said_when_it_is_reached(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Many evaluators on one loop: the verdict of each doubles what there is to be seen."""
    rows = [
        f"    judge{i} = MissionEvaluator\n    mend{i} = MissionModifier emits COMPLETED, FAILED\n"
        f"    judge{i} -> allocate when STANDBY\n    judge{i} -> mend{i} when FAILED\n"
        f"    mend{i} -> end when FAILED\n    [judge{i}, mend{i}] -> judge{i + 1} when COMPLETED\n"
        for i in range(7)
    ]
    text = f"""{FLOWN}
    judge7 = MissionModifier emits STANDBY, COMPLETED
    watch -> judge0 when COMPLETED
    judge7 -> judge0 when COMPLETED
    judge7 -> allocate when STANDBY
{"".join(rows)}"""
    assert errors(text) == []
    monkeypatch.setattr(statuses, "MOST_PLACES", 500)
    (found,) = findings(text)
    assert found.code == "P2026"
    assert "more than 500 states" in found.message


def test_of_many_ways_round_for_failures_a_few_are_shown() -> None:
    """To look for one from each of thousands of blocks on one loop took hours."""
    n = 300
    rows = [
        f"    m{i} = MissionModifier emits STANDBY, COMPLETED, FAILED\n"
        f"    m{i} -> m{(i + 1) % n} when STANDBY\n    m{i} -> m{(7 * i + 3) % n} when COMPLETED\n"
        f"    m{i} -> m{(13 * i + 5) % n} when FAILED"
        for i in range(1, n)
    ]
    text = """
    create = MissionCreator
    m0 = MissionModifier emits STANDBY, COMPLETED, FAILED
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    start -> create -> allocate -> launch -> watch -> m0
    m0 -> m1 when STANDBY
    m0 -> m5 when FAILED
    m0 -> end when COMPLETED
"""
    codes = [found.code for found in findings(text + "\n".join(rows))]
    assert set(codes) == {"P2056"}
    assert len(codes) == 10
