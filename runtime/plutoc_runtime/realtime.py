"""Real time: the same heap of events, driven by asyncio's clock. One thread flies all missions."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from functools import partial
from inspect import iscoroutinefunction
from typing import TypeVar

from .kernel import Kernel, Key, Kind, Signal, Timer

T = TypeVar("T")


class RealTime(Kernel):
    """The kernel of real flights; made and used inside a running asyncio loop."""

    def __init__(self) -> None:
        super().__init__()
        self._loop = asyncio.get_running_loop()
        self._start = self._loop.time()
        self._frozen: float | None = None
        self._armed: asyncio.TimerHandle | None = None
        self._over = asyncio.Event()

    @property
    def now(self) -> float:
        """Seconds since the start; it stands still while the events of one instant are taken."""
        return self._loop.time() - self._start if self._frozen is None else self._frozen

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight, local time."""
        local = time.localtime()
        return local.tm_hour * 3600.0 + local.tm_min * 60.0 + local.tm_sec

    def at(self, when: float, kind: Kind, key: Key, call: Callable[[], None]) -> Timer:
        """Call this at a time; a hook may ask for it between the kernel's own events."""
        timer = super().at(when, kind, key, call)
        if self._frozen is None:
            self._arm()
        return timer

    def post(self, call: Callable[[], None]) -> None:
        """Tell the kernel something from outside: an answer of a drone, of a hook, of a person."""
        call()
        self._arm()

    async def run(self, done: Signal[T]) -> T:
        """Go on until it is done."""
        self._over.clear()
        done.watch(self._over.set)
        self._arm()
        await self._over.wait()
        if self.crashed is not None:
            raise self.crashed
        return done.result()

    def _arm(self) -> None:
        if self._frozen is not None:
            return  # the drain that is under way arms when it is through
        if self._armed is not None:
            self._armed.cancel()
        when = self.next_time()
        self._armed = None
        if when is not None:
            self._armed = self._loop.call_at(self._start + when, self._drain)

    def _drain(self) -> None:
        self._frozen = self._loop.time() - self._start
        try:
            while (when := self.next_time()) is not None and when <= self._frozen:
                self.take()
                if self.crashed is not None:
                    self._over.set()
                    return
        finally:
            self._frozen = None
        self._arm()

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook beside the missions: `async def` as a task, `def` in a thread."""
        call = partial(hook, *args, **named)
        if iscoroutinefunction(hook):
            running: asyncio.Future[object] = asyncio.ensure_future(hook(*args, **named))
        else:
            running = self._loop.run_in_executor(None, call)
        result: Signal[object] = Signal()

        def finished(future: asyncio.Future[object]) -> None:
            if future.cancelled():
                return
            error = future.exception()
            if error is not None:
                self.post(partial(result.fail, error))
            else:
                self.post(partial(result.set, future.result()))

        running.add_done_callback(finished)
        try:
            return await result
        finally:
            running.cancel()

    async def offer(self, signal: Signal[T]) -> T:
        """Return what a hook, an asyncio task here, may await for this signal."""
        happened = asyncio.Event()
        signal.watch(happened.set)
        try:
            await happened.wait()
        finally:
            signal.unwatch(happened.set)
        return signal.result()
