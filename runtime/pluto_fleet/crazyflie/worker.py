"""The one thread that calls cflib for a drone, so that no other drone waits when a call hangs.

A thread cannot be stopped from outside. One that hangs is given up: it is a daemon, so the process
can end in spite of it, and the drone gets another one when it is connected to again.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from queue import SimpleQueue
from threading import Thread
from typing import Generic, TypeVar

from plutoc_runtime.domain.errors import ANY_ERROR

from ..drones.errors import LinkLost
from . import messages

T = TypeVar("T")


@dataclass(slots=True, eq=False)
class _Call(Generic[T]):
    """A call that waits for its turn, and the future of its caller."""

    call: Callable[[], T]
    loop: asyncio.AbstractEventLoop
    answer: asyncio.Future[T]
    dropped: bool = False
    """Its caller has given up: it need not begin."""

    def run(self) -> None:
        if self.dropped:
            return
        try:
            value = self.call()
        except ANY_ERROR as error:
            self._tell(self._fail, error)
        else:
            self._tell(self._give, value)

    def _tell(self, call: Callable[..., None], what: object) -> None:
        with suppress(RuntimeError):  # the loop is closed
            self.loop.call_soon_threadsafe(call, what)

    def _give(self, value: T) -> None:
        if not self.answer.done():
            self.answer.set_result(value)

    def _fail(self, error: BaseException) -> None:
        if not self.answer.done():
            self.answer.set_exception(error)


class Worker:
    """A daemon thread that takes one call after the other; made and used in an event loop."""

    def __init__(self, drone: str) -> None:
        self._drone = drone
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.stuck = False
        """A call has not come back in its time, and none is taken any more."""
        self._thread = Thread(target=self._work, name=f"cflib for {drone}", daemon=True)
        self._thread.start()

    async def call(self, call: Callable[[], T], limit: float) -> T:
        """Return what a call gives; raise `LinkLost` if it is not back within the limit."""
        if self.stuck:
            raise LinkLost(messages.stuck(self._drone, limit))
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[T] = loop.create_future()
        job = _Call(call, loop, answer)
        self._jobs.put(job.run)
        try:
            await asyncio.wait({answer}, timeout=limit)
            if answer.done():
                return answer.result()
        finally:  # cancelled, too
            job.dropped = True
            answer.cancel()
        self.stuck = True
        raise LinkLost(messages.stuck(self._drone, limit))

    def post(self, call: Callable[[], object]) -> None:
        """Call this some time; how it ends is not told."""

        def run() -> None:
            with suppress(Exception):
                call()

        self._jobs.put(run)

    def end(self) -> None:
        """Let the thread end, after what it does now."""
        self._jobs.put(None)

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()
