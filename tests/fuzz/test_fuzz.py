"""Odd input: the only exceptions are `Rejected`, and no file leaves its folder.

`python -m tests.fuzz --minutes 10` does the same for longer.
"""

from __future__ import annotations

from tests.fuzz.__main__ import one
from tests.fuzz.trial import Tally

SEEDS = range(80)


def test_much_odd_input_breaks_nothing() -> None:
    """And much of it gets all the way to a package."""
    tally = Tally()
    for seed in SEEDS:
        tally.add(one(seed))
    assert tally.accepted.total() > len(SEEDS) // 10
    assert len(tally.made) == 3
    assert len(tally.codes) > 25
