"""How numbers lie."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil, floor
from statistics import mean, median


def spread(values: Iterable[float]) -> dict[str, float] | None:
    """Return the distribution of some numbers; None if there are none."""
    ordered = sorted(values)
    if not ordered:
        return None
    return {
        "min": ordered[0],
        "p5": percentile(ordered, 0.05),
        "median": median(ordered),
        "mean": mean(ordered),
        "p90": percentile(ordered, 0.90),
        "p95": percentile(ordered, 0.95),
        "max": ordered[-1],
    }


def percentile(ordered: Sequence[float], share: float) -> float:
    """Return a percentile, interpolated between two neighbours."""
    place = share * (len(ordered) - 1)
    below = ordered[floor(place)]
    above = ordered[ceil(place)]
    return min(below + (above - below) * (place - floor(place)), above)
