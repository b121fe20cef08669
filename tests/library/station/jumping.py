"""An asyncio loop for whole stations: its clock jumps to what comes next, once no thread works for it."""

from __future__ import annotations

import asyncio
import selectors
from collections.abc import Callable, Coroutine
from concurrent.futures import Executor
from typing import Any, TypeVar

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.store import Entry, Store

T = TypeVar("T")

A_LOOK = 0.001
"""Seconds between two looks at what a thread has done meanwhile."""
LONG = 5.0
"""Seconds after which it is said that nothing happens any more."""
A_STEP = 1e-6
"""Seconds that each step of the loop takes: without them what is due in an instant would never be."""


class _Selector(selectors.DefaultSelector):
    """Lets time pass instead of waiting."""

    passes: Callable[[float], float]
    """Lets so many seconds pass at most, and returns for how many of them to wait."""

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Return what can be read now."""
        ready = super().select(0)
        if ready or timeout == 0:
            self.passes(A_STEP)
            return ready
        if timeout is not None:
            return super().select(self.passes(timeout + A_STEP))
        if not self.passes(A_LOOK) and not (ready := super().select(LONG)):
            raise RuntimeError("nothing will ever happen again, and a task still waits")
        return ready


class JumpingLoop(asyncio.SelectorEventLoop):
    """Sockets are those of this process; what a thread is asked to do takes no time."""

    def __init__(self) -> None:
        self.now = 1000.0
        self.goes_on = False
        """Whether time passes as it does outside while a thread works; else none does."""
        self._threads = 0
        selector = _Selector()
        selector.passes = self._pass
        super().__init__(selector)

    def time(self) -> float:
        """Return the time as all here know it."""
        return self.now

    def _pass(self, seconds: float) -> float:
        if not self._threads:
            self.now += seconds
            return 0.0
        waits = min(seconds, A_LOOK)
        if self.goes_on:
            self.now += waits
        return waits

    def run_in_executor(  # type: ignore[override]  # as `asyncio` has it, but for a type variable
        self, executor: Executor | None, func: Callable[..., Any], *args: Any
    ) -> asyncio.Future[Any]:
        """Do this in a thread, and let no time pass before it is done."""
        self._threads += 1
        done = super().run_in_executor(executor, func, *args)
        done.add_done_callback(self._is_done)
        return done

    def _is_done(self, _: object) -> None:
        self._threads -= 1


def run(flight: Coroutine[Any, Any, T]) -> T:
    """Run this to its end in time that jumps."""
    with asyncio.Runner(loop_factory=JumpingLoop) as runner:
        return runner.run(flight)


class AtOnce:
    """A `Writer` of a journal without a thread: what is added is durable in the loop's next step."""

    def __init__(
        self,
        store: Store,
        on_durable: Callable[[int], object],
        on_failure: Callable[[JournalError], object],
    ) -> None:
        self._store, self._on_durable, self._on_failure = store, on_durable, on_failure
        self._entries: list[Entry] = []
        self._added = store.seq

    def add(self, entry: Entry) -> int:
        """Add an entry and return its number."""
        if not self._entries:
            asyncio.get_running_loop().call_soon(self._write)
        self._entries.append(entry)
        self._added += 1
        return self._added

    def flush(self) -> None:
        """Make all added entries durable; raise a `JournalError` if that fails."""
        entries = self._entries
        self._entries = []
        if self._store.failure is not None:
            raise self._store.failure
        if entries:
            self._store.append(entries)
            self._on_durable(self._added)

    def _write(self) -> None:
        try:
            self.flush()
        except JournalError as failure:
            self._on_failure(failure)

    def close(self) -> None:
        """Write the rest."""
        self._write()
