"""Two vehicles with one system id: what they tell is mixed without a word, and seen by clocks and places that jump."""

from __future__ import annotations

from collections import deque
from itertools import pairwise
from math import dist

from ..shared.domain.model import Point

_LOOKS_AT = 30
"""The latest positions, some seconds of them."""
_ENOUGH = 6
"""How many of them must not follow from the one before: a restart and a poor fix are one each."""
_JUMP = 1.5
"""Metres that a position may be off from where it is by its speed."""
_BEATS = 8
_FLIPS = 4
"""Of the latest heartbeats, as many may not say of the motors what the one before did not."""


class Twins:
    """Whether positions are those of one vehicle."""

    def __init__(self) -> None:
        self._heard: deque[tuple[int, Point]] = deque(maxlen=_LOOKS_AT)
        self._odd: deque[bool] = deque(maxlen=_LOOKS_AT)
        self._armed: deque[bool] = deque(maxlen=_BEATS)

    def hear(self, clock: int, position: Point, speed: float) -> None:
        """Take a position and the milliseconds since the vehicle was switched on."""
        if (clock, position) in self._heard:
            return  # it came by two ways
        before, there = self._heard[-1] if self._heard else (clock, position)
        passed = abs(clock - before) / 1000
        jumps = dist(there, position) > _JUMP + 2 * speed * passed
        self._odd.append(clock < before or jumps)
        self._heard.append((clock, position))

    def beat(self, armed: bool) -> None:
        """Take a heartbeat: one that was just switched on tells nothing else, if it is not asked."""
        self._armed.append(armed)

    @property
    def are_there(self) -> bool:
        flips = sum(one != other for one, other in pairwise(self._armed))
        return sum(self._odd) >= _ENOUGH or flips >= _FLIPS
