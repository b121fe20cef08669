"""The one thread that calls cflib for a drone, so that no other drone waits when a call hangs.

A thread cannot be stopped from outside. One that hangs is given up: it is a daemon, so the process
can end in spite of it, and the drone gets another one when it is connected to again.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from queue import SimpleQueue
from threading import Thread
from typing import TypeVar

from plutoc_runtime.domain.errors import ANY_ERROR

from ..drones.errors import LinkLost
from . import messages

T = TypeVar("T")


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
        job: Future[T] = Future()
        self._jobs.put(partial(_run, job, call))
        answer = asyncio.wrap_future(job)
        try:
            await asyncio.wait({answer}, timeout=limit)
            if answer.done():
                return answer.result()
        finally:  # cancelled, too: it need not begin
            job.cancel()
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


def _run(job: Future[T], call: Callable[[], T]) -> None:
    """Call what its caller still waits for."""
    if job.set_running_or_notify_cancel():
        try:
            job.set_result(call())
        except ANY_ERROR as error:
            job.set_exception(error)
