"""What a heat map shows between the places of measurements: the formula that pages must agree with.

Shepard's inverse distance weighting with a bounded reach (Franke and Little). docs/station.md says it
in words, and tests/library/station/results/vectors.json by examples, which the pages' own must give as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import hypot

Sample = tuple[float, float, float]
"""x and y in metres, and the value that was measured there."""

SAME_PLACE = 0.001
"""Metres within which two places are one."""


def newest(samples: Iterable[Sample]) -> list[Sample]:
    """Return the last sample of each place, the newest at the end; places are told apart by millimetres."""
    kept: dict[tuple[int, int], Sample] = {}
    for x, y, value in samples:
        place = round(x * 1000), round(y * 1000)
        kept.pop(place, None)
        kept[place] = x, y, value
    return list(kept.values())


def heat_at(samples: Sequence[Sample], x: float, y: float, reach: float) -> float | None:
    """Return the value of a heat map at a point; None: unknown, no sample is within `reach` metres.

    A sample at distance d counts with the weight (1/d - 1/reach)²: all at its own place, and nothing at
    its reach, so that the map has no edges but those to the unknown. `samples` have one for each
    place, as `newest` returns them.
    """
    weights = total = 0.0
    nearest, there = SAME_PLACE, None
    for sx, sy, value in samples:
        distance = hypot(x - sx, y - sy)
        if distance <= nearest:
            nearest, there = distance, value
        elif distance < reach:
            weight = (1 / distance - 1 / reach) ** 2
            weights += weight
            total += weight * value
    if there is not None:
        return there
    return total / weights if weights else None
