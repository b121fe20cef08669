"""The charge of one small lithium cell, by its voltage at rest."""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise

_VOLTS = (3.27, 3.61, 3.69, 3.73, 3.77, 3.80, 3.84, 3.87, 3.95, 4.02, 4.11, 4.18)
_LEVELS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)

SAG = 0.3
"""Volts by which a cell's voltage usually drops when the drone hovers."""


def level_at(volts: float) -> float:
    """Return the charge of a cell at this voltage, from 0 to 1."""
    at = bisect_right(_VOLTS, volts)
    if at in (0, len(_VOLTS)):
        return float(at > 0)
    share = (volts - _VOLTS[at - 1]) / (_VOLTS[at] - _VOLTS[at - 1])
    return _LEVELS[at - 1] + share * (_LEVELS[at] - _LEVELS[at - 1])


def volts_at(level: float) -> float:
    """Return the voltage of a cell with this charge."""
    for (less, low), (more, high) in pairwise(zip(_LEVELS, _VOLTS, strict=True)):
        if level <= more:
            return low + (high - low) * (level - less) / (more - less)
    return _VOLTS[-1]
