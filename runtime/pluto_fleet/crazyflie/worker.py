"""The thread that calls cflib for a drone, so that no other drone waits when a call hangs.

A thread cannot be stopped from outside. One that hangs is abandoned: it is a daemon, so that the process can
end, and the drone gets a new one when it is reconnected.
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

from ..drones.errors import LinkLost
from ..shared.domain.errors import ANY_ERROR
from . import messages

T = TypeVar("T")


class Worker:
    """A daemon thread that runs one call after the other; made and used in an event loop."""

    def __init__(self, drone: str) -> None:
        self._drone = drone
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.stuck = False
        """Whether a call has not returned in time: further ones are refused."""
        self._thread = Thread(target=self._work, name=f"cflib for {drone}", daemon=True)
        self._thread.start()

    async def call(self, call: Callable[[], T], limit: float) -> T:
        """Run a call, and return its result; raise `LinkLost` after the time-out."""
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
        """Queue a call, without waiting for its result."""

        def run() -> None:
            with suppress(Exception):
                call()

        self._jobs.put(run)

    def end(self) -> None:
        """End the thread after its present call."""
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
