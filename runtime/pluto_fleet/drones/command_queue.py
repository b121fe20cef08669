"""The commands of a drone, one after the other; an aborted one ends in a hover."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any, TypeVar

from ..shared.domain.errors import Failure, FlightFailed

T = TypeVar("T")

_CANNOT_HOVER = frozenset({Failure.LINK, Failure.CRASH})
"""Failures after which a drone cannot be commanded to hover."""


class CommandQueue:
    """The commands of one drone."""

    def __init__(self, hold: Callable[[], Coroutine[Any, Any, None]]) -> None:
        self._hold = hold
        self._turn = asyncio.Lock()
        self._over: asyncio.Future[None] | None = None
        """Fails when the command in progress is aborted."""
        self._brake: asyncio.Task[None] | None = None
        self.doing = ""
        """The command in progress."""

    async def run(self, doing: str, work: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """Run a command after all earlier ones; raise `FlightFailed` as soon as it is aborted.

        When it is cancelled, aborted or fails, the drone is left hovering.
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
        """Abort the command in progress, if any: it raises this."""
        if self._over is not None and not self._over.done():
            self._over.set_exception(error)

    def release(self) -> None:
        """Stop waiting until it hovers."""
        if self._brake is not None:
            self._brake.cancel()

    async def idle(self) -> None:
        """Wait until no command is in progress."""
        async with self._turn:
            await self._braked()

    def _stop(self, task: asyncio.Task[Any], holds: bool) -> None:
        self._brake = asyncio.ensure_future(self._braking(task, holds))

    async def _braking(self, task: asyncio.Task[Any], holds: bool) -> None:
        """End the last command in a hover before the next one begins."""
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
    """Retrieve the exception: the caller has been told already."""
    if not task.cancelled():
        task.exception()
