"""A bar on standard error for those who wait at a terminal, or a line now and then elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TextIO

from plutoc_runtime import output

_AFTER, _EVERY = 1.0, 0.1
"""Seconds of real time until the bar appears, and between two pictures of it."""

_WIDTH = 30


class Progress:
    """How far the work is."""

    def __init__(self, stream: TextIO, clock: Callable[[], float], *, shown: bool) -> None:
        self._stream, self._clock, self._possible = stream, clock, shown
        self._next = clock() + _AFTER
        self._drawn = 0

    def update(self, share: float, text: str) -> None:
        """So much of 1 is done."""
        if not self._possible or (now := self._clock()) < self._next:
            return
        self._next = now + _EVERY
        done = round(max(0.0, min(1.0, share)) * _WIDTH)
        line = f"[{'#' * done}{'.' * (_WIDTH - done)}] {text}"
        self._write("\r" + line.ljust(self._drawn))
        self._drawn = len(line)

    def clear(self) -> None:
        """Take the bar away."""
        if self._drawn:
            self._write("\r" + " " * self._drawn + "\r")
            self._drawn = 0

    def _write(self, text: str) -> None:
        try:
            self._stream.write(text)
            self._stream.flush()
        except OSError:
            self._possible = False


def on_terminal(*, quiet: bool) -> Progress:
    """Return a bar on standard error; none if nobody sits there, or reads lines there already."""
    error, out = sys.stderr, sys.stdout
    seen = error is not None and not error.closed and error.isatty()
    busy = not quiet and out is not None and not out.closed and out.isatty()
    return Progress(error, time.monotonic, shown=seen and not busy)


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
