"""What a drone is told, one thing after the other; what is broken off ends in a hover."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any, TypeVar

from plutoc_runtime.domain.errors import Failure, FlightFailed

T = TypeVar("T")

_CANNOT_HOVER = frozenset({Failure.LINK, Failure.CRASH})
"""Failures after which a drone cannot be told to hover."""


class CommandQueue:
    """The commands of one drone."""

    def __init__(self, hold: Callable[[], Coroutine[Any, Any, None]]) -> None:
        self._hold = hold
        self._turn = asyncio.Lock()
        self._over: asyncio.Future[None] | None = None
        """Fails when what is under way is broken off."""
        self._brake: asyncio.Task[None] | None = None
        self.doing = ""
        """What is under way."""

    async def run(self, doing: str, work: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """Do this when all else is done; raise `FlightFailed` as soon as it is broken off.

        When it is cancelled, broken off or fails, the drone is left hovering.
        """
        async with self._turn:
            await self._braked()
            over = self._over = asyncio.get_running_loop().create_future()
            self.doing = doing
            task = asyncio.ensure_future(work())
            task.add_done_callback(_heard)
            try:
                await asyncio.wait((task, over), return_when=asyncio.FIRST_COMPLETED)
                if over.done():
                    over.result()
                return task.result()
            except FlightFailed as error:
                self._stop(task, error.failure not in _CANNOT_HOVER)
                raise
            except asyncio.CancelledError:
                self._stop(task, True)
                raise
            finally:
                over.cancel()
                self._over, self.doing = None, ""

    def fail(self, error: FlightFailed) -> None:
        """Break off what is under way, if anything is: it raises this."""
        if self._over is not None and not self._over.done():
            self._over.set_exception(error)

    def release(self) -> None:
        """Do not wait until it hovers."""
        if self._brake is not None:
            self._brake.cancel()

    async def idle(self) -> None:
        """Wait until nothing is under way."""
        async with self._turn:
            await self._braked()

    def _stop(self, task: asyncio.Task[Any], holds: bool) -> None:
        self._brake = asyncio.ensure_future(self._braking(task, holds))

    async def _braking(self, task: asyncio.Task[Any], holds: bool) -> None:
        """Let what was under way end before anything else begins."""
        task.cancel()
        await asyncio.wait((task,))
        if holds:
            await self._hold()

    async def _braked(self) -> None:
        """Wait until it hovers, or cannot; that goes on when this is cancelled."""
        brake = self._brake
        if brake is not None:
            await asyncio.wait((brake,))
            if self._brake is brake:
                self._brake = None
            with suppress(asyncio.CancelledError, FlightFailed):
                brake.result()


def _heard(task: asyncio.Task[Any]) -> None:
    """Take note of how it ended: its caller has been told why."""
    if not task.cancelled():
        task.exception()
