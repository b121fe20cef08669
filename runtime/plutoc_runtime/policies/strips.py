"""Strips of equal breadth across one direction: the columns, or the rows, of a grid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

GRAIN = 1e-12
"""What is lost by rounding is a smaller share of a number than this."""


class Strips:
    """Where things stand in one direction; the outermost strips hold also what stands beyond.

    What is said to be so far away at least has a grain of tolerance: rounding makes it no farther.
    """

    __slots__ = ("_breadth", "_least", "_most", "_start", "count")

    def __init__(self, line: Sequence[float], breadth: float) -> None:
        self._start = self._least = min(line)
        self._most = max(line)
        self._breadth = breadth
        self.count = int((self._most - self._least) / breadth) + 1

    def hold(self, at: float) -> int:
        """Return the strip for what stands here, and remember how far they reach."""
        if at < self._least:
            self._least = at
        elif at > self._most:
            self._most = at
        return self._strip(at)

    def gap(self, at: float) -> float:
        """Return how far from here all is at least that they hold."""
        grain = self._grain(at)
        return max(self._least - at, at - self._most, grain) - grain

    def outward(self, at: float) -> Iterator[tuple[int, float]]:
        """Give the strips from here on, the nearest first, and how far away each is at least."""
        grain, away, breadth = self._grain(at), at - self._start, self._breadth
        here = self._strip(at)
        yield here, self.gap(at)
        low, high = here - 1, here + 1
        down = away - here * breadth if low >= 0 else inf
        up = high * breadth - away if high < self.count else inf
        while up < inf or down < inf:
            if up <= down:
                yield high, max(up, grain) - grain
                high += 1
                up = high * breadth - away if high < self.count else inf
            else:
                yield low, max(down, grain) - grain
                down = away - low * breadth if low else inf
                low -= 1

    def _grain(self, at: float) -> float:
        return GRAIN * (abs(at) + abs(self._start) + self._most - self._least)

    def _strip(self, at: float) -> int:
        return min(max(int((at - self._start) / self._breadth), 0), self.count - 1)
