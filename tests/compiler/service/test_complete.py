"""Completion: what was cut out of an example is among the first, and any place of any text has an answer."""

from __future__ import annotations

import random

from tests.lsp.holes import FIRST, cuts, mistakes, offered, rank


def test_what_was_cut_out_is_among_the_first_and_all_that_is_offered_is_legal() -> None:
    """A share of the thousand holes of `python -m tests.lsp`."""
    chosen = random.Random(3).sample(cuts(1000), 25)
    among = 0
    for cut in chosen:
        made = offered(cut)
        assert mistakes(cut, made) == [], (cut.path, cut.word)
        found = rank(cut, made)
        among += found is not None and found < FIRST
    assert among >= 0.95 * len(chosen)
