"""What a navigation does to its process: blocks the event loop, or leaves something behind.

As a busy machine delays the loop, too, it is not the clock that counts, but how many samples in a row show
the loop busy in the very same turn. Waiting for a started thread to run is the machine's delay, too.
"""

from __future__ import annotations

import asyncio
import gc
import socket
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Self

LOOK = 0.01
"""The sampling interval, in seconds."""
LOOKS = 10
"""This many in a row are 100 ms: a machine with much else to do holds a loop up for 50, too."""
_KIT = Path(__file__).parent
_IDLE = ("select", "poll", "_run_once", "run_forever")
"""The functions in which an idle loop is."""


class LoopWatch:
    """Watches the running event loop within this context."""

    def __init__(self) -> None:
        self.found: list[str] = []
        """A sentence for each block."""
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
                inner = _outside_library(frame)
                if Path(inner.f_code.co_filename).parent != _KIT:  # the machine's delay, too
                    looks += 1
                    where = _place(inner)
                continue
            if looks >= LOOKS:
                self.found.append(f"{looks * LOOK:.2f} s {where}")
            looks, turns = 0, self._turns
        if looks >= LOOKS:
            self.found.append(f"{looks * LOOK:.2f} s {where}")


def _waits(frame: FrameType) -> bool:
    """Whether a thread is idle, or waits for a started thread to run."""
    at: FrameType | None = frame
    while at is not None and at.f_code.co_filename == threading.__file__:
        if at.f_code is threading.Thread.start.__code__:
            return True
        at = at.f_back
    return frame.f_code.co_name in _IDLE


def _outside_library(frame: FrameType) -> FrameType:
    """Return the innermost frame outside of the standard library."""
    library = str(Path(asyncio.__file__).parent.parent)
    at: FrameType | None = frame
    while at is not None and at.f_code.co_filename.startswith((library, "<")):
        at = at.f_back
    return at or frame


def _place(frame: FrameType) -> str:
    return f"in {frame.f_code.co_name}, {frame.f_code.co_filename}:{frame.f_lineno}"


_EXECUTOR = "asyncio_"
"""Threads of the loop's own pool: the loop ends them."""


@dataclass(frozen=True, slots=True)
class Resources:
    """The resources of the process at one moment."""

    threads: frozenset[threading.Thread]
    tasks: frozenset[asyncio.Task[object]]
    sockets: frozenset[tuple[int, int]]
    """Each by its identity and its file descriptor."""


def resources() -> Resources:
    return Resources(
        threads=frozenset(
            thread
            for thread in threading.enumerate()
            if not thread.daemon and not thread.name.startswith(_EXECUTOR)
        ),
        tasks=frozenset(asyncio.all_tasks()),
        sockets=frozenset(
            (id(one), one.fileno())
            for one in gc.get_objects()
            if type(one) is socket.socket and one.fileno() >= 0
        ),
    )


async def left_since(before: Resources, seconds: float = 1.0) -> list[str]:
    """Return the resources that are new since then and still there after a while, described."""
    loop = asyncio.get_running_loop()
    limit = loop.time() + seconds
    while found := _found(before, resources()):
        if loop.time() > limit:
            break
        await asyncio.sleep(0.05)
    return found


def _found(before: Resources, now: Resources) -> list[str]:
    threads = [f"the thread {one.name}" for one in now.threads - before.threads]
    tasks = [f"the task {one.get_coro()}" for one in now.tasks - before.tasks]
    sockets = [f"a socket, number {number}" for _, number in now.sockets - before.sockets]
    return sorted(threads) + sorted(tasks) + sorted(sockets)
