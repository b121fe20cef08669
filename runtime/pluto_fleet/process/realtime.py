"""Real time: the same heap of events, driven by asyncio's clock. One thread flies all missions."""

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

    With simulated drones, time may pass at another speed than on the wall. Who goes on where another
    life of the app has ended begins later than at 0.
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
        """Return the seconds since the start; they stand still while an instant is taken."""
        return self.now if self._draining else self._clock()

    def _clock(self) -> float:
        return self._begin + (self._loop.time() - self._start) * self._speed

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight, local time."""
        local = time.localtime()
        return local.tm_hour * 3600.0 + local.tm_min * 60.0 + local.tm_sec

    def schedule(self, when: float, kind: EventKind, key: Key, call: Call) -> None:
        """Call this at a time; a hook may ask for it between the kernel's own events."""
        if self._draining:
            super().schedule(when, kind, key, call)
        else:
            self.now = self.time()
            super().schedule(when, kind, key, call)
            self._arm()

    def post(self, call: Callable[..., object], *args: object) -> None:
        """Tell the kernel something from outside: that is an instant of its own."""
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
        except ANY_ERROR as error:  # it must not leave everybody waiting for ever
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
        """Go on until it is done."""
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
        """See to it that the next event is taken in time."""
        when = self.next_time()
        if when is None or when >= self._armed_for:
            return  # what is armed comes early enough, and arms again
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
        """Run a hook beside the missions: `async def` as a task, `def` in a thread.

        One that never waits is over as soon as it is called, as in virtual time: so what happens at one
        instant has the same order in both.
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
        """Call this in a thread of its own: one that never comes back does not keep the app from ending."""
        ended: asyncio.Future[Callable[[], object]] = self._loop.create_future()

        def finish(end: Callable[[], object]) -> None:
            if not ended.done():
                ended.set_result(end)

        def tell(end: Callable[[], object]) -> None:
            with suppress(RuntimeError):  # the loop is closed: the answer is not awaited any longer
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
        """Return what a hook, an asyncio task here, may await for this future."""
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
    """There is nothing to tell; what is due is taken all the same."""


def _raise(error: BaseException) -> NoReturn:
    raise error


@coroutine
def _alone(hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Let a hook run inside this coroutine, guarded: a copy of the process does not go on."""
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = guarded(step)
        except StopIteration as end:
            returned: T = end.value
            return returned
        try:
            step = partial(hook.send, (yield waits_for))
        except ANY_ERROR as error:  # the hook hears of it
            step = partial(hook.throw, error)


def _never_waits(hook: Callable[..., object]) -> bool:
    """Say whether this is an `async def` without any `await`, `async for` or `async with`."""
    code = getattr(getattr(hook, "func", hook), "__code__", None)  # a partial carries its function
    return isinstance(code, CodeType) and _runs_through(code)


@lru_cache(maxsize=1_000)
def _runs_through(code: CodeType) -> bool:
    waits = opmap.get("SEND")  # what every way to wait is compiled to
    return bool(waits and code.co_flags & CO_COROUTINE and waits not in code.co_code[::2])
