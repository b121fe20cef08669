"""Finds out where an event loop is held up, and how long, by looking on from another thread.

A busy machine holds up a loop as well, and is nobody's fault: so it is not the clock that counts, but
how often in a row the loop was seen in the very same turn, doing something. A loop that starts a
thread waits for the machine, too: until that thread runs.
"""

from __future__ import annotations

import asyncio
import sys
import threading
from pathlib import Path
from types import FrameType
from typing import Self

LOOK = 0.01
"""Seconds between two looks."""
LOOKS = 5
"""So many in a row are 50 ms."""
_IDLE = ("select", "poll", "_run_once", "run_forever")
"""What a loop is in when it does nothing."""


class LoopWatch:
    """Watches the running event loop while it is entered."""

    def __init__(self) -> None:
        self.found: list[str] = []
        """A sentence for each time."""
        self._turns = 0
        self._over = threading.Event()
        self._loop = asyncio.get_running_loop()
        self._watched = threading.get_ident()
        self._timer: asyncio.Handle | None = None
        self._thread = threading.Thread(target=self._watch, name="loop watch", daemon=True)

    def __enter__(self) -> Self:
        self._turn()
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        if self._timer is not None:
            self._timer.cancel()
        self._thread.join()

    def _turn(self) -> None:
        self._turns += 1
        self._timer = self._loop.call_later(LOOK / 2, self._turn)

    def _watch(self) -> None:
        looks, turns, where = 0, -1, ""
        while not self._over.wait(LOOK):
            frame = sys._current_frames().get(self._watched)
            if frame is not None and not _waits(frame) and self._turns == turns:
                looks, where = looks + 1, _place(frame)
                continue
            if looks >= LOOKS:
                self.found.append(f"{looks * LOOK:.2f} s {where}")
            looks, turns = 0, self._turns
        if looks >= LOOKS:
            self.found.append(f"{looks * LOOK:.2f} s {where}")


def _waits(frame: FrameType) -> bool:
    """Whether a thread is idle, or waits until a thread that it has started runs."""
    at: FrameType | None = frame
    while at is not None and at.f_code.co_filename == threading.__file__:
        if at.f_code is threading.Thread.start.__code__:
            return True
        at = at.f_back
    return frame.f_code.co_name in _IDLE


def _place(frame: FrameType) -> str:
    """Return the line of code that a thread is in: the innermost that is not of Python itself."""
    library = str(Path(asyncio.__file__).parent.parent)
    at: FrameType | None = frame
    while at is not None and at.f_code.co_filename.startswith((library, "<")):
        at = at.f_back
    at = at or frame
    return f"in {at.f_code.co_name}, {at.f_code.co_filename}:{at.f_lineno}"
