"""What those see who wait for `plutoc test`: a bar at a terminal, a line now and then elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

from plutoc_runtime import output

from ..cli.progress import Progress

EVERY = 10.0
"""Seconds of real time between two lines."""


class Patience:
    """Says how far the work is, and that it goes on."""

    def __init__(
        self, bar: Progress, clock: Callable[[], float], say: Callable[[str], object] | None
    ) -> None:
        self._bar, self._clock, self._say = bar, clock, say
        self._next = clock() + EVERY

    def tell(self, share: float, text: str) -> None:
        """So much of 1 is done."""
        self._bar.update(share, text)
        if self._say is not None and (now := self._clock()) >= self._next:
            self._next = now + EVERY
            self._say(f"plutoc test: {text}")

    def over(self) -> None:
        """Take the bar away: what is found comes now."""
        self._bar.clear()


def patience(*, lines: bool) -> Patience:
    """Return who tells those that wait at standard error."""
    seen = sys.stderr is not None and sys.stderr.isatty()
    bar = Progress(sys.stderr, time.monotonic, shown=seen)
    return Patience(bar, time.monotonic, output.tell if lines and not seen else None)
