"""Running the hooks of a brain in real time."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from threading import get_ident
from typing import TypeVar

from ..shared.time.kernel import Watcher
from .hook_calls import End, end_at_once, end_of, never_waits
from .realtime import RealTime

T = TypeVar("T")


class RealHooks:
    """The `HookRunner` of real flights; made inside a running asyncio loop."""

    def __init__(self, kernel: RealTime) -> None:
        self._kernel, self._loop = kernel, asyncio.get_running_loop()
        self._thread = get_ident()
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
        """Call a hook; return whether it has ended."""
        if never_waits(hook):
            self._ends[number] = end_at_once(call)
            return True
        self._running[number] = asyncio.ensure_future(self._run(number, hook, call))
        return False

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

    def deliver(self, call: Callable[[], T]) -> T:
        """Make a call of a hook in the brain's own time, whichever thread the hook runs in."""
        if get_ident() == self._thread:
            return call()
        made: Future[T] = Future()

        def make() -> None:
            try:
                made.set_result(call())
            except BaseException as error:  # noqa: BLE001 - it is raised in the hook
                made.set_exception(error)

        self._loop.call_soon_threadsafe(make)
        return made.result()

    async def _run(
        self, number: int, hook: Callable[..., object], call: Callable[[], object]
    ) -> None:
        """Wait for a hook, and post that it has ended, unless it was cancelled."""
        end = await end_of(hook, call)
        if self._running.pop(number, None) is not None:
            self._ends[number] = end
            self._kernel.post(self.ended, number)


def _ignore(*_: object) -> None:
    """The default listener: ignores the answer."""
