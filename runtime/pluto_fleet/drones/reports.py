"""A help for whoever writes a navigation: what a drone tells, kept, and waited for.

Most libraries call back when their drone tells something, and do not say when a command is over. So
each navigation keeps the last that was told, and waits until that says so: under a limit, and with an
eye on silence and crashes. Nobody must use this.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from math import inf, isfinite
from typing import TYPE_CHECKING, TypeVar

from .errors import Crashed, LinkLost, OutsideArea, Rejected, TargetTimeout
from .telemetry import CRASHED, DroneEvent, DroneTelemetry

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .setup import DroneSetup

T = TypeVar("T")

SILENCE = 1.0
"""Seconds without a word, after which a link is lost."""
_LOOK = 0.02


class Reports:
    """What one drone tells; used within the event loop only."""

    def __init__(self, setup: DroneSetup) -> None:
        self._id = setup.id
        self.telemetry = DroneTelemetry(
            time=-inf, position=setup.home, yaw=0.0, voltage=0.0, battery_level=1.0, flying=False
        )
        """The last it told."""
        self.crashed = ""
        """Why it is said to have crashed, if it has."""
        self._events: asyncio.Queue[DroneEvent | None] = asyncio.Queue()

    def tell(
        self,
        *,
        position: Point,
        flying: bool,
        yaw: float = 0.0,
        voltage: float = 0.0,
        battery_level: float = 1.0,
        crashed: str = "",
    ) -> None:
        """Hear what it tells, at this moment; `crashed` is the reason, or nothing."""
        self.telemetry = DroneTelemetry(
            time=time.monotonic(),
            position=position,
            yaw=yaw,
            voltage=voltage,
            battery_level=battery_level,
            flying=flying,
        )
        if crashed and not self.crashed:
            self.happened(CRASHED, crashed)
        self.crashed = crashed

    def from_thread(self, hear: Callable[[T], object]) -> Callable[[T], object]:
        """Return what any thread may call, for `hear` to be called within the event loop."""
        loop = asyncio.get_running_loop()

        def hand_over(told: T) -> None:
            with suppress(RuntimeError):  # the loop is closed: nobody wants to hear any more
                loop.call_soon_threadsafe(hear, told)

        return hand_over

    def happened(self, kind: str, reason: str) -> None:
        """Tell of something that nobody has asked for, once."""
        self._events.put_nowait(DroneEvent(kind=kind, reason=reason))

    def refuse(self, target: Point, speed: float) -> None:
        """Raise if it cannot be told to go there: no such place or speed, or it does not fly."""
        if not all(map(isfinite, target)) or target[2] < 0:
            raise OutsideArea(f"{self._id} cannot go to {target}")
        if not 0 < speed < inf:
            raise Rejected(f"{self._id} cannot fly at {speed} m/s")
        if not self.telemetry.flying:
            raise Rejected(f"{self._id} stands on the ground")

    async def until(self, done: Callable[[DroneTelemetry], bool], seconds: float) -> None:
        """Wait until this holds of something that is told from now on.

        Raises `LinkLost` when it tells nothing, `Crashed` when it tells just that, and
        `TargetTimeout` after so many seconds.
        """
        began = time.monotonic()
        while self.telemetry.time <= began or not done(self.telemetry):
            now = time.monotonic()
            if self.crashed:
                raise Crashed(f"{self._id} has crashed: {self.crashed}")
            if now - max(began, self.telemetry.time) > SILENCE:
                raise LinkLost(f"{self._id} has told nothing for {SILENCE:.0f} s")
            if now - began > seconds:
                raise TargetTimeout(f"{self._id} is not there after {seconds:.0f} s")
            await asyncio.sleep(_LOOK)

    async def events(self) -> AsyncIterator[DroneEvent]:
        """Yield what happens, until `close`."""
        while (event := await self._events.get()) is not None:
            yield event

    def close(self) -> None:
        """Tell nothing more."""
        self._events.put_nowait(None)
