"""How hard a picture is to read."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from .ground import Point

_BEND, _CROSSING = 30.0, 60.0
"""What a bend and a crossing are as bad as, in lengths of way."""


def unrest(ways: Sequence[Sequence[Point]]) -> float:
    """Return the length of all ways, and more for bends and for crossings."""
    pieces = [piece for way in ways for piece in pairwise(way)]
    length = sum(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in pieces)
    bends = sum(len(way) - 2 for way in ways)
    flat = [(min(a[0], b[0]), max(a[0], b[0]), a[1]) for a, b in pieces if a[1] == b[1]]
    steep = [(min(a[1], b[1]), max(a[1], b[1]), a[0]) for a, b in pieces if a[1] != b[1]]
    crossings = sum(
        left < x < right and top < y < bottom for left, right, y in flat for top, bottom, x in steep
    )
    return length + _BEND * bends + _CROSSING * crossings
