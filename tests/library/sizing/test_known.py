"""Plans whose answer is known, and a few by chance; `python -m tests.sizing` has many of those."""

from __future__ import annotations

import pytest

from tests.sizing.plans import (
    Known,
    by_chance,
    fresh_share,
    known,
    sized_plan,
    smallest_by_trying_all,
    without_chance,
)


@pytest.mark.parametrize("case", known(), ids=lambda case: case.name.replace(" ", "-"))
def test_the_known_answer_is_found(case: Known) -> None:
    """The size, or the cause."""
    assert case.wrong(sized_plan(case.plan, confidence=0.8)) == ""


@pytest.mark.parametrize("number", [2, 5, 24])
def test_no_smaller_fleet_does(number: int) -> None:
    """Of plans without chance every fleet is flown once; 24 is in time with eleven drones, and not with twelve."""
    plan = without_chance(number)
    answer = sized_plan(plan, confidence=0.8)
    assert smallest_by_trying_all(plan) == (answer.found and answer.found.drones)


def test_a_promise_holds_in_fresh_runs() -> None:
    """With other seeds, as often as was said."""
    answer = sized_plan(by_chance(1), confidence=0.8)
    assert answer.found is not None
    assert fresh_share(answer, runs=100, seed=1_000_000, jobs=1) >= 0.8
