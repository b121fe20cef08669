"""An asyncio loop whose clock jumps to what comes next: ten minutes take a moment."""

from __future__ import annotations

import asyncio
import selectors
from collections.abc import Callable, Coroutine
from typing import Any, TypeVar

T = TypeVar("T")


class _Selector(selectors.DefaultSelector):
    """Instead of waiting, lets the time pass."""

    def __init__(self) -> None:
        super().__init__()
        self.passes: Callable[[float], None] | None = None

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Return what can be read now."""
        ready = super().select(0)
        if not ready and timeout is None:
            raise RuntimeError("nothing will ever happen again, and a task still waits")
        if not ready and timeout and self.passes is not None:
            self.passes(timeout)
        return ready


class JumpingLoop(asyncio.SelectorEventLoop):
    """Nothing of it may need the outside: no sockets, no threads."""

    def __init__(self) -> None:
        self.now = 1000.0
        selector = _Selector()
        selector.passes = self.advance
        super().__init__(selector)

    def time(self) -> float:
        """Return the time as all here know it."""
        return self.now

    def advance(self, seconds: float) -> None:
        """Let time pass: within a step of a task, that is as if it blocked."""
        self.now += seconds


def run(flight: Coroutine[Any, Any, T]) -> T:
    """Run this to its end; nothing may be left of it."""
    with asyncio.Runner(loop_factory=JumpingLoop) as runner:
        value = runner.run(flight)
        left = asyncio.all_tasks(runner.get_loop())
    assert not left
    return value


def the_loop() -> JumpingLoop:
    """Return the loop that runs."""
    loop = asyncio.get_running_loop()
    assert isinstance(loop, JumpingLoop)
    return loop
