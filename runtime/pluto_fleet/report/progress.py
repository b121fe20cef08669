"""Progress: a bar on standard error at a terminal, or occasional lines elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TextIO

from ..shared import output

_AFTER, _EVERY = 1.0, 0.1
"""Seconds of real time until the bar appears, and between two updates."""

LINE_EVERY = 10.0
"""Seconds of real time between two lines."""

_WIDTH = 30


class Progress:
    """Shows the progress of a long task."""

    def __init__(
        self,
        stream: TextIO,
        clock: Callable[[], float],
        *,
        shown: bool,
        say: Callable[[str], object] | None = None,
    ) -> None:
        """Without a bar (`shown`), `say` is called with a line now and then."""
        self._stream, self._clock, self._shown = stream, clock, shown
        self._say = None if shown else say
        self._next = clock() + (_AFTER if shown else LINE_EVERY)
        self._drawn = 0

    @property
    def is_told(self) -> bool:
        """Whether an update is worth its while."""
        return self._shown or self._say is not None

    def update(self, share: float, text: str) -> None:
        """Show this share, from 0 to 1."""
        if not (self._shown or self._say) or (now := self._clock()) < self._next:
            return
        if self._say is not None:
            self._next = now + LINE_EVERY
            self._say(text)
            return
        self._next = now + _EVERY
        done = round(max(0.0, min(1.0, share)) * _WIDTH)
        line = f"[{'#' * done}{'.' * (_WIDTH - done)}] {text}"
        self._write("\r" + line.ljust(self._drawn))
        self._drawn = len(line)

    def clear(self) -> None:
        """Remove the bar."""
        if self._drawn:
            self._write("\r" + " " * self._drawn + "\r")
            self._drawn = 0

    def _write(self, text: str) -> None:
        try:
            self._stream.write(text)
            self._stream.flush()
        except OSError:
            self._shown = False


def simulation_progress(*, quiet: bool) -> Progress:
    """Return a bar, shown on a terminal to which nothing else is printed."""
    busy = not quiet and _is_terminal(sys.stdout)
    return Progress(sys.stderr, time.monotonic, shown=_is_terminal(sys.stderr) and not busy)


def trial_progress(*, lines: bool) -> Progress:
    """Return a bar on a terminal, or lines elsewhere."""
    say = (lambda text: output.tell(f"plutoc test: {text}")) if lines else None
    return Progress(sys.stderr, time.monotonic, shown=_is_terminal(sys.stderr), say=say)


def _is_terminal(stream: TextIO | None) -> bool:
    return stream is not None and not stream.closed and stream.isatty()
