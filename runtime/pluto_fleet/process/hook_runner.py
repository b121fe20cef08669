"""Running the hooks of a brain in real time: an `async def` as a task of asyncio, a `def` in a thread."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Coroutine, Generator
from contextlib import suppress
from functools import lru_cache, partial
from inspect import CO_COROUTINE, iscoroutinefunction
from opcode import opmap
from threading import Thread
from types import CodeType, CoroutineType, coroutine
from typing import Any, NoReturn, TypeVar, cast

from plutoc_runtime.domain.errors import ANY_ERROR
from plutoc_runtime.domain.guard import as_a_fault, guarded
from plutoc_runtime.time.future import Watcher

from .forked import end_if_forked
from .realtime import RealTime
from .signal_guard import by_a_person

T = TypeVar("T")

End = Callable[[], object]
"""Returns what a hook returned, or raises what it raised."""


class RealHooks:
    """The `HookRunner` of real flights; made inside a running asyncio loop."""

    def __init__(self, kernel: RealTime) -> None:
        self._kernel, self._loop = kernel, asyncio.get_running_loop()
        self.ended: Callable[[int], object] = _ignore
        """Called within the kernel with the number of a hook that has ended."""
        self.stir: Callable[[], object] = _ignore
        """Called within the kernel when a hook has made something due."""
        self._ends: dict[int, End] = {}
        self._running: dict[int, asyncio.Future[None]] = {}

    def now(self) -> float:
        """Return the seconds since the start."""
        return self._kernel.time()

    def start(self, number: int, hook: Callable[..., object], call: Callable[[], object]) -> bool:
        """Call a hook; return whether it has ended.

        One that never waits ends within the call, as in virtual time, so that simultaneous events have
        the same order in both.
        """
        if not _never_waits(hook):
            self._running[number] = asyncio.ensure_future(self._run(number, hook, call))
            return False
        try:
            returned = _run_through(cast("Coroutine[Any, Any, object]", guarded(call)))
        except ANY_ERROR as error:
            if by_a_person(error):
                raise
            self._ends[number] = partial(_raise, error)
        else:
            self._ends[number] = lambda: returned
        return True

    def result(self, number: int) -> object:
        """Return what a hook that has ended returned, or raise what it raised."""
        return self._ends.pop(number)()

    def cancel(self, number: int) -> None:
        """Cancel a hook."""
        self._ends.pop(number, None)
        running = self._running.pop(number, None)
        if running is not None:
            running.cancel()

    async def offer(self, watch: Callable[[Watcher], object]) -> None:
        """Wait, as a task of asyncio, until the watcher is called."""
        happened = asyncio.Event()
        watch(lambda _: happened.set())
        await happened.wait()

    def stirred(self) -> None:
        """Called when a hook has made something due."""
        self._kernel.post(self.stir)

    async def _run(
        self, number: int, hook: Callable[..., object], call: Callable[[], object]
    ) -> None:
        """Wait for a hook, and post that it has ended."""
        try:
            returned = call() if iscoroutinefunction(hook) else await self._in_thread(call)
            if issubclass(type(returned), CoroutineType):  # it may be anything
                returned = await _alone(cast("Coroutine[Any, Any, object]", returned))
        except ANY_ERROR as error:
            if by_a_person(error):
                raise
            self._ends[number] = partial(_raise, as_a_fault(error))
        else:
            self._ends[number] = lambda: returned
        if self._running.pop(number, None) is None:
            del self._ends[number]  # it was cancelled, and does not care
        else:
            self._kernel.post(self.ended, number)

    async def _in_thread(self, call: Callable[[], object]) -> object:
        """Call this in a daemon thread: one that never returns does not keep the app from exiting."""
        ended: asyncio.Future[End] = self._loop.create_future()

        def finish(end: End) -> None:
            if not ended.done():
                ended.set_result(end)

        def tell(end: End) -> None:
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


def _ignore(*_: object) -> None:
    """Nobody listens yet."""


def _raise(error: BaseException) -> NoReturn:
    raise error


def _run_through(hook: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine that never waits to its end."""
    try:
        guarded(partial(hook.send, None))
    except StopIteration as end:
        returned: T = end.value
        return returned
    raise RuntimeError("a hook without any `await` waits")


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
