"""Odd input: the only exceptions are `Rejected`, and no file leaves its folder.

`python -m tests.fuzz --minutes 10` does the same for longer.
"""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fuzz.tally import WRITTEN_EVERY, Tally
from tests.fuzz.trial import trial

SEEDS = range(300)


def test_much_odd_input_breaks_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    """What came of it is printed; much of it gets all the way to a package."""
    tally = Tally()
    for seed in SEEDS:
        tally.add(trial(Random(seed), on_disk=seed % WRITTEN_EVERY == 0))
    with capsys.disabled():
        print("\n" + "\n".join(tally.lines()))
    assert tally.made.total() == len(SEEDS)
    assert tally.accepted.total() > len(SEEDS) // 10
    assert all(tally.accepted[way] for way in tally.made)
    assert len(tally.codes) > 40


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.randoms(use_true_random=False))
def test_chance_that_hypothesis_chooses_breaks_nothing(random: Random) -> None:
    """It tries the ends of every range, and makes what fails as small as it can."""
    trial(random)
