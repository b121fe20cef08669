"""Real time: the same heap of events, driven by asyncio's clock. One thread flies all missions."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from inspect import iscoroutine, iscoroutinefunction
from threading import Thread
from typing import NoReturn, TypeVar

from .kernel import Ending, Kernel, Key, Kind, Signal, Timer

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
        done.watch(self._over.set)
        self._arm()
        while not (done.is_set or self.crashed):  # what was waited for before may end meanwhile
            self._over.clear()
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
                self._take()
                if self.crashed is not None:
                    self._over.set()
                    return
        finally:
            self._frozen = None
        self._arm()

    def _take(self) -> None:
        """Take the next event; an error there must not leave everybody waiting for ever."""
        end = Ending()
        with end:
            self.take()
            return
        self.crash(end.error)

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook beside the missions: `async def` as a task, `def` in a thread."""
        result: Signal[object] = Signal()
        running = asyncio.ensure_future(self._answer(hook, partial(hook, *args, **named), result))
        try:
            return await result
        finally:
            running.cancel()

    async def _answer(
        self, hook: Callable[..., object], call: Callable[[], object], result: Signal[object]
    ) -> None:
        """Wait for a hook, and post what it ends with, whatever that is."""
        end = Ending()
        with end:
            returned = call() if iscoroutinefunction(hook) else await self._in_thread(call)
            if iscoroutine(returned):
                returned = await returned
            self.post(partial(result.set, returned))
            return
        self.post(partial(result.fail, end.error))

    async def _in_thread(self, call: Callable[[], object]) -> object:
        """Call this in a thread of its own: one that never comes back keeps nobody from leaving."""
        ended: asyncio.Future[Callable[[], object]] = self._loop.create_future()

        def finish(end: Callable[[], object]) -> None:
            if not ended.done():
                ended.set_result(end)

        def tell(end: Callable[[], object]) -> None:
            with suppress(RuntimeError):  # the loop is closed: nobody waits any longer
                self._loop.call_soon_threadsafe(finish, end)

        def work() -> None:
            end = Ending(())
            with end:
                returned = call()
                tell(lambda: returned)
                return
            tell(partial(_raise, end.error))

        Thread(target=work, name="hook", daemon=True).start()
        return (await ended)()

    async def offer(self, signal: Signal[T]) -> T:
        """Return what a hook, an asyncio task here, may await for this signal."""
        happened = asyncio.Event()
        signal.watch(happened.set)
        try:
            await happened.wait()
        finally:
            signal.unwatch(happened.set)
        return signal.result()


def _raise(error: BaseException) -> NoReturn:
    raise error
