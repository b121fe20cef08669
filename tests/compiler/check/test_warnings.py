"""What is allowed, but most likely not meant."""

from __future__ import annotations

import pytest

from tests.compiler.check.graphs import BASIC, GATED, codes, findings

STRAIGHT = f"""{BASIC}
    start -> create -> allocate -> launch -> watch
    watch -> allocate when STANDBY"""
RETRY = """
    retry = PriorityManager
    watch -> retry when FAILED
    retry -> allocate when STANDBY
    retry -> end"""


END = "\n    watch -> end"
GUARDED = STRAIGHT.replace(
    "start -> create -> allocate -> launch",
    "start -> create -> allocate when UNEXECUTED, STANDBY\n    allocate -> launch",
)
UNBOUNDED = RETRY.replace("PriorityManager", "PriorityManager(max_attempts: 0)")


@pytest.mark.parametrize(
    ("code", "text"),
    [
        ("P2051", f"{STRAIGHT}{RETRY}"),
        ("P2052", f"{GUARDED}{RETRY}{END}"),
        ("P2053", f"{STRAIGHT}{RETRY}{END}\n    create -> end otherwise"),
        ("P2055", f"{STRAIGHT}{END}"),
        ("P2056", f"{STRAIGHT}{UNBOUNDED}{END}".replace("    retry -> end\n", "")),
        ("P2056", f"{STRAIGHT}, FAILED{END}"),
    ],
)
def test_each_warning_is_given(code: str, text: str) -> None:
    """One warning, and nothing besides."""
    assert codes(text) == [code]


def test_an_otherwise_behind_a_retry_of_nothing_is_mentioned() -> None:
    """A mission that was judged has no trip left, and ends in the retry."""
    text = f"""{STRAIGHT}{RETRY}
    judge = MissionEvaluator
    mend = PriorityManager
    watch -> judge when COMPLETED
    judge -> mend when FAILED
    judge -> allocate when STANDBY
    judge -> end
    mend -> allocate otherwise"""
    assert codes(text) == ["P2053"]


def test_a_drone_that_waits_for_a_delay_is_held() -> None:
    """No other mission can use it meanwhile; before the allocation it would be free."""
    held = f"{STRAIGHT}{RETRY}\n    watch -> end".replace(
        "allocate -> launch", "allocate -> wait -> launch"
    )
    assert codes(f"{held}\n    wait = Clock") == ["P2054"]


def test_repeating_before_judging_is_mentioned() -> None:
    """The evaluator would see the last round only."""
    text = f"""{STRAIGHT}{RETRY}
    again = MissionRepeater
    judge = MissionEvaluator
    watch -> again when COMPLETED
    again -> allocate when STANDBY
    again -> judge
    judge -> allocate when STANDBY
    judge -> end"""
    assert codes(text) == ["P2057"]


def test_judging_before_repeating_is_not_mentioned() -> None:
    """Each round is judged, though a launch leads from the repeater back to the evaluator."""
    text = f"""{STRAIGHT}{RETRY}
    again = MissionRepeater
    judge = MissionEvaluator
    watch -> judge
    judge -> allocate when STANDBY
    judge -> again when COMPLETED
    judge -> end when FAILED
    again -> allocate when STANDBY
    again -> end"""
    assert codes(text) == []


def test_a_bound_on_attempts_is_no_bound_where_what_is_over_it_is_let_in_again() -> None:
    """FAILED leaves the bounded retry, and an allocator takes it back into the loop."""
    text = f"""{STRAIGHT}
    retry = PriorityManager
    watch -> retry when FAILED
    watch -> end
    retry -> allocate when STANDBY, FAILED"""
    assert codes(text) == ["P2056"]


def test_a_loop_that_goes_on_only_when_a_trip_succeeds_needs_no_bound() -> None:
    """Rounds, and what an evaluator asks for, are not failures."""
    text = f"""{GATED}
    again = MissionRepeater
    retry = PriorityManager
    first -> allocate when STANDBY
    first -> again when COMPLETED
    again -> allocate when STANDBY
    again -> end
    first -> retry when FAILED
    retry -> allocate when STANDBY
    retry -> end"""
    assert codes(text) == []


def test_the_loop_that_fails_for_ever_is_shown() -> None:
    """The help names the blocks of the loop, in their order."""
    (found,) = findings(f"{STRAIGHT}, FAILED\n    watch -> end")
    assert found.help == (
        "bound the number of attempts in the loop allocate → launch → watch → allocate"
    )
