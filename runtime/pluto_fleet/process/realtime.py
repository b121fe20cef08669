"""Real time: the same heap of events, driven by asyncio's clock, in one thread for all missions."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial
from math import inf
from typing import TypeVar

from ..shared.domain.errors import ANY_ERROR
from ..shared.time.kernel import Call, EventKind, Future, Kernel, Key, Timer
from .hook_calls import End, end_at_once, end_of, never_waits
from .signal_guard import by_a_person, guard_hooks

T = TypeVar("T")


class RealTime(Kernel):
    """The kernel of real flights; made and used inside a running asyncio loop.

    With simulated drones, time may run faster than the real clock. A resumed app starts at the time
    at which the previous process ended.
    """

    def __init__(self, speed: float = 1.0, begin: float = 0.0) -> None:
        super().__init__()
        guard_hooks()
        self.now = self._begin = begin
        self._loop = asyncio.get_running_loop()
        self.speed = speed
        self._start = self._loop.time()
        self._draining = False
        self._armed: asyncio.TimerHandle | None = None
        self._armed_for = inf
        self._woken = asyncio.Event()

    def time(self) -> float:
        """Return the seconds since the start; constant while an instant is processed."""
        return self.now if self._draining else self._clock()

    def _clock(self) -> float:
        return self._begin + (self._loop.time() - self._start) * self.speed

    def pass_at(self, speed: float) -> None:
        """Let time pass at another speed from now on; it does not jump."""
        self._begin = self._clock()
        self._start = self._loop.time()
        self.speed = speed
        self._disarm()
        if not self._draining:
            self._arm()

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Schedule a call; hooks may do so between the kernel's own events."""
        if self._draining:
            return super().at(when, kind, key, call)
        self.now = self.time()
        timer = super().at(when, kind, key, call)
        self._arm()
        return timer

    def post(self, call: Callable[..., object], *args: object) -> None:
        """Deliver something from outside, as an instant of its own."""
        if self._draining:
            call(*args)
            return
        self.now = self._clock()
        self._draining = True
        try:
            call(*args)
            self.drain()
            if self.settled is not None:
                self.settled()
        except ANY_ERROR as error:  # else everything would wait for ever
            if by_a_person(error):
                raise
            self.crash(error)
        finally:
            self._draining = False
        if self.over:
            self._woken.set()
        else:
            self._arm()

    async def run(self, done: Future[T]) -> T:
        """Run until this future is set."""
        done.watch(self._stop)
        while not done.is_set and self.crashed is None:
            self.over = False
            self._woken.clear()
            self.post(_nothing)
            await self._woken.wait()
        if self.crashed is not None:
            raise self.crashed
        return done.result()

    def _stop(self, _: object) -> None:
        self.over = True
        self._woken.set()

    def _arm(self) -> None:
        """Set asyncio's timer to the next event."""
        when = self.next_time()
        if when is None or when >= self._armed_for:
            return  # the timer that is set comes earlier, and is set again then
        self._disarm()
        self._armed_for = when
        self._armed = self._loop.call_at(self._start + (when - self._begin) / self.speed, self._due)

    def _disarm(self) -> None:
        if self._armed is not None:
            self._armed.cancel()
        self._armed = None
        self._armed_for = inf

    def _due(self) -> None:
        self._disarm()
        self.post(_nothing)

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook concurrently: an `async def` as a task, a `def` in a thread."""
        call = partial(hook, *args, **named)
        if never_waits(hook):
            return end_at_once(call)()
        ended: Future[End] = Future()
        running = asyncio.ensure_future(self._answer(hook, call, ended))
        try:
            return (await ended)()
        finally:
            running.cancel()

    async def _answer(
        self, hook: Callable[..., object], call: Callable[[], object], ended: Future[End]
    ) -> None:
        self.post(ended.set, await end_of(hook, call))

    async def offer(self, future: Future[T]) -> T:
        """Wrap a future so that a hook, an asyncio task here, can await it."""
        happened = asyncio.Event()

        def tell(_: object) -> None:
            happened.set()

        future.watch(tell)
        try:
            await happened.wait()
        finally:
            future.unwatch(tell)
        return future.result()


def _nothing() -> None:
    """Post nothing: only what is due is processed."""
