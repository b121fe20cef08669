"""Real time: the same heap of events, driven by asyncio's clock, in one thread for all missions."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Callable, Coroutine, Generator
from contextlib import suppress
from functools import lru_cache, partial
from inspect import CO_COROUTINE, iscoroutinefunction
from math import inf
from opcode import opmap
from threading import Thread
from types import CodeType, CoroutineType, coroutine
from typing import Any, NoReturn, TypeVar, cast

from plutoc_runtime.domain.errors import ANY_ERROR
from plutoc_runtime.domain.guard import as_a_fault, guarded
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import Call, EventKind, Kernel, Key

from .forked import end_if_forked
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
        self._loop, self._speed = asyncio.get_running_loop(), speed
        self._start = self._loop.time()
        self._draining = False
        self._armed: asyncio.TimerHandle | None = None
        self._armed_for = inf
        self._woken = asyncio.Event()

    def time(self) -> float:
        """Return the seconds since the start; constant while an instant is processed."""
        return self.now if self._draining else self._clock()

    def _clock(self) -> float:
        return self._begin + (self._loop.time() - self._start) * self._speed

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight, local time."""
        local = time.localtime()
        return local.tm_hour * 3600.0 + local.tm_min * 60.0 + local.tm_sec

    def schedule(self, when: float, kind: EventKind, key: Key, call: Call) -> None:
        """Schedule a call; hooks may do so between the kernel's own events."""
        if self._draining:
            super().schedule(when, kind, key, call)
        else:
            self.now = self.time()
            super().schedule(when, kind, key, call)
            self._arm()

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
        if self._armed is not None:
            self._armed.cancel()
        self._armed_for = when
        self._armed = self._loop.call_at(
            self._start + (when - self._begin) / self._speed, self._due
        )

    def _due(self) -> None:
        self._armed, self._armed_for = None, inf
        self.post(_nothing)

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook concurrently: an `async def` as a task, a `def` in a thread.

        One that never waits ends within the call, as in virtual time, so that simultaneous events have
        the same order in both.
        """
        if _never_waits(hook):
            return await _alone(cast("Coroutine[Any, Any, object]", hook(*args, **named)))
        result: Future[object] = Future()
        running = asyncio.ensure_future(self._answer(hook, partial(hook, *args, **named), result))
        try:
            return await result
        finally:
            running.cancel()

    async def _answer(
        self, hook: Callable[..., object], call: Callable[[], object], result: Future[object]
    ) -> None:
        """Wait for a hook, and post its result or its error."""
        try:
            returned = call() if iscoroutinefunction(hook) else await self._in_thread(call)
            if issubclass(type(returned), CoroutineType):  # it may be anything
                returned = await _alone(cast("Coroutine[Any, Any, object]", returned))
        except ANY_ERROR as error:
            if by_a_person(error):
                raise
            self.post(result.fail, as_a_fault(error))
        else:
            self.post(result.set, returned)

    async def _in_thread(self, call: Callable[[], object]) -> object:
        """Call this in a daemon thread: one that never returns does not keep the app from exiting."""
        ended: asyncio.Future[Callable[[], object]] = self._loop.create_future()

        def finish(end: Callable[[], object]) -> None:
            if not ended.done():
                ended.set_result(end)

        def tell(end: Callable[[], object]) -> None:
            with suppress(RuntimeError):  # the loop is closed: the answer is not needed any more
                self._loop.call_soon_threadsafe(finish, end)

        parent = os.getpid()

        def work() -> None:
            try:
                returned = call()
            except ANY_ERROR as error:
                end_if_forked(parent, error)
                tell(partial(_raise, error))
            else:
                end_if_forked(parent)
                tell(lambda: returned)

        Thread(target=work, name="hook", daemon=True).start()
        return (await ended)()

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


def _raise(error: BaseException) -> NoReturn:
    raise error


@coroutine
def _alone(hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Run a hook inside this coroutine, guarded: a forked copy of the process ends there."""
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = guarded(step)
        except StopIteration as end:
            returned: T = end.value
            return returned
        try:
            step = partial(hook.send, (yield waits_for))
        except ANY_ERROR as error:  # raised in the hook
            step = partial(hook.throw, error)


def _never_waits(hook: Callable[..., object]) -> bool:
    """Return whether this is an `async def` without any `await`, `async for` or `async with`."""
    code = getattr(getattr(hook, "func", hook), "__code__", None)  # a partial carries its function
    return isinstance(code, CodeType) and _runs_through(code)


@lru_cache(maxsize=1_000)
def _runs_through(code: CodeType) -> bool:
    waits = opmap.get("SEND")  # every `await` is compiled to it
    return bool(waits and code.co_flags & CO_COROUTINE and waits not in code.co_code[::2])
