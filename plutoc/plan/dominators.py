"""What must be passed on the way to each place: the dominators of a flow chart.

Cooper, Harvey and Kennedy, "A Simple, Fast Dominance Algorithm". A library knows it, too, but to
import that takes longer than to compile a small app.
"""

from __future__ import annotations

from collections.abc import Sequence


def immediate_dominators(before: Sequence[Sequence[int]]) -> list[int]:
    """Return for each place the last one that every way there passes; for the first, itself.

    Places are counted so that each stands behind some place that leads to it; `before` has for each
    those that lead to it.
    """
    unknown = -1
    above = [0, *(unknown for _ in before[1:])]
    changed = True
    while changed:
        changed = False
        for place in range(1, len(before)):
            found = unknown
            for one in before[place]:
                if above[one] == unknown:
                    continue  # it leads back, and its turn comes later
                found = one if found == unknown else _common(found, one, above)
            if found != above[place]:
                above[place] = found
                changed = True
    return above


def _common(one: int, other: int, above: Sequence[int]) -> int:
    """Return the last place that the ways to both pass."""
    while one != other:
        while one > other:
            one = above[one]
        while other > one:
            other = above[other]
    return one
