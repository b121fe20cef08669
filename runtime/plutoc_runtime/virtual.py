"""Virtual time: the clock jumps to the next event. Nothing sleeps, and a day takes a moment."""

from __future__ import annotations

from collections.abc import Callable
from inspect import iscoroutine
from typing import TypeVar

from .kernel import ForeignAwait, Kernel, Signal

T = TypeVar("T")


class Stuck(RuntimeError):
    """Nothing will ever happen again, and somebody still waits."""


class VirtualTime(Kernel):
    """The kernel of simulations. Its day begins at midnight."""

    def __init__(self) -> None:
        super().__init__()
        self._now = 0.0

    @property
    def now(self) -> float:
        """Seconds since the start."""
        return self._now

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight: the simulation starts then."""
        return self._now % 86_400

    def run(self, done: Signal[T], until: float | None = None) -> bool:
        """Go on until it is done, or until a time; say whether it is done."""
        while not done.is_set:
            when = self.next_time()
            if when is None:
                waiting = ", ".join(sorted(task.name for task in self.tasks))
                raise Stuck(f"nothing will ever happen again; waiting: {waiting}")
            if until is not None and when > until:
                self._now = until
                return False
            self._now = when
            self.take()
            if self.crashed is not None:
                raise self.crashed
        return True

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook here and now; an `async def` may await only what its context offers."""
        result = hook(*args, **named)
        if not iscoroutine(result):
            return result
        try:
            return await result
        except RuntimeError as error:
            if isinstance(error, ForeignAwait) or "no running event loop" in str(error):
                raise RuntimeError(
                    "in a simulation a hook may await only what its context offers "
                    "(context.sleep, context.trip_ended), not asyncio"
                ) from error
            raise

    async def offer(self, signal: Signal[T]) -> T:
        """Return what a hook may await for this signal."""
        return await signal
