"""Tangled graphs: how much is looked at, and that it is said where that is not all."""

from __future__ import annotations

import tracemalloc

import pytest

from plutoc.check import forks, reach, statuses
from plutoc.diagnostic import Severity
from plutoc.plan.build import build
from plutoc.plan.optimise import optimised
from tests.compiler.check.graphs import BASIC, checked, findings

FLOWN = f"""{BASIC}
    start -> create -> allocate -> launch -> watch -> allocate when STANDBY
    watch -> end when FAILED
"""


def errors(text: str) -> list[str]:
    return [found.code for found in findings(text) if found.severity is Severity.ERROR]


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


def test_of_many_ways_round_for_failures_one_is_told_and_a_few_are_shown() -> None:
    """To look for one from each of thousands of blocks on one loop took hours."""
    n = 60
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
    (found,) = findings(text + "\n".join(rows))
    assert found.code == "P2056"
    assert len(found.related) == 9


def looped(n: int) -> str:
    """Judges in a row, and a way back."""
    rows = [
        f"    judge{i} = MissionEvaluator\n    judge{i} -> allocate when STANDBY\n"
        f"    judge{i} -> end when FAILED\n    judge{i} -> judge{i + 1} when COMPLETED\n"
        for i in range(n)
    ]
    return f"""{FLOWN}
    judge{n} = MissionModifier emits STANDBY, COMPLETED
    watch -> judge0 when COMPLETED
    judge{n} -> judge0 when COMPLETED
    judge{n} -> allocate when STANDBY
{"".join(rows)}"""


def test_what_is_remembered_of_many_verdicts_takes_little_room() -> None:
    """A row of 2,000 took half a minute and more than a gigabyte."""
    assert errors(looped(50)) == []
    tracemalloc.start()
    assert errors(looped(200)) == []
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6


def test_steps_between_states_are_bounded_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of one fork that begins in many, each branch goes on with each of those that it began for."""
    n = 30
    rows = [
        f"    before{i} = MissionModifier\n    branch{i} = MissionModifier\n"
        f"    choice{i} = MissionModifier emits COMPLETED, FAILED\n"
        f"    choice{i} -> before{i} when FAILED\n    before{i} -> [fork, note]\n"
        f"    choice{i} -> choice{i + 1} when COMPLETED\n    fork -> branch{i} -> inner\n"
        for i in range(n)
    ]
    text = f"""{FLOWN}
    fork = MissionModifier
    note = MissionModifier
    inner = GateFIFO
    outer = GateFIFO
    choice{n} = MissionModifier
    watch -> choice0 when COMPLETED
    [inner, note] -> outer -> end
    choice{n} -> end
{"".join(rows)}"""
    assert errors(text) == []
    monkeypatch.setattr(statuses, "MOST_STEPS", 1_000)
    (found,) = findings(text)
    assert found.code == "P2026"
    assert "more than 1,000 ways" in found.message


@pytest.mark.long  # twenty seconds; fewer bounds are above
def test_of_hundreds_of_unlike_bounds_each_is_remembered() -> None:
    """The retries lead FAILED to each other and back: once all have given up, nothing ends that."""
    n = 470
    rows = [
        f"    retry{i} = PriorityManager(max_attempts: {i + 1})\n"
        f"    retry{i} -> allocate when STANDBY\n    retry{i} -> retry{(i + 1) % n} when FAILED\n"
        for i in range(n)
    ]
    flown = FLOWN.replace("watch -> end", "watch -> retry0")
    (found,) = findings(f"{flown}    watch -> end when COMPLETED\n{''.join(rows)}")
    assert found.code in ("P2010", "P2026")


def test_points_to_go_on_at_may_be_many_on_one_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a mission remembers of each of them must not multiply the states."""
    n = 100
    rows = [
        f"    wait{i} = Clock\n    say{i} = MissionModifier emits STANDBY, UNEXECUTED\n"
        f"    other{i} = DroneAllocator\n    wait{i} -> say{i} -> other{i} when UNEXECUTED\n"
        f"    say{i} -> wait{(i + 1) % n} when STANDBY\n    other{i} -> allocate\n"
        for i in range(n)
    ]
    text = f"""
    create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    start -> create -> wait0
    allocate -> launch -> watch
    watch -> wait1 when STANDBY
    watch -> end
{"".join(rows)}"""
    monkeypatch.setattr(statuses, "MOST_PLACES", 40 * n)
    assert errors(text) == []


def nested(n: int) -> str:
    """Forks, each in the one before."""
    rows = [
        f"    fork{i} = MissionModifier\n    beside{i} = MissionModifier\n    gate{i} = GateFunnel\n"
        f"    fork{i} -> [fork{i + 1}, beside{i}]\n    beside{i} -> gate{i}\n"
        f"    gate{i + 1} -> gate{i}\n"
        for i in range(n)
    ]
    rows[-1] = rows[-1].replace(f"gate{n} ->", f"fork{n} ->")
    return f"""{FLOWN}
    fork{n} = MissionModifier
    watch -> fork0 when COMPLETED
    gate0 -> end
{"".join(rows)}"""


def test_forks_lie_only_so_deep_in_each_other() -> None:
    """Twice as deep, the app could not be written."""
    assert errors(nested(forks.MOST_NESTED)) == []
    assert optimised(build(checked(nested(forks.MOST_NESTED))))
    (found,) = findings(nested(forks.MOST_NESTED + 1))
    assert found.code == "P2026"


def test_forks_that_lie_too_deep_are_told_before_all_are_looked_at(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of 10,000 the analysis took 24 s."""
    monkeypatch.setattr(statuses, "MOST_PLACES", 10 * forks.MOST_NESTED)
    (found,) = findings(nested(20 * forks.MOST_NESTED))
    assert found.code == "P2026"
    assert "more than 100 deep" in found.message


def test_stops_after_stops_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each clock lets those on that were stopped there to the next, which can be stopped there."""
    n = 30
    rows = [
        f"    wait{i} = Clock\n    mark{i} = MissionModifier emits UNEXECUTED\n"
        f"    mark{i} -> wait{i} -> allocate when UNEXECUTED\n"
        f"    wait{i} -> mark{i + 1} when STANDBY\n"
        for i in range(n)
    ]
    rows[-1] = rows[-1].replace(f"mark{n}", "mark0")
    text = f"{FLOWN}    watch -> end when COMPLETED\n{''.join(rows)}".replace(
        "watch -> allocate when", "watch -> mark0 when"
    )
    assert "P2026" not in errors(text)
    monkeypatch.setattr(statuses, "MOST_PLACES", 500)
    monkeypatch.setattr(reach, "starved", lambda _: [])  # told first: the clocks are starved
    assert errors(text) == ["P2026"]
