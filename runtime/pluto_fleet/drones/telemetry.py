"""The telemetry of one drone: collected by its navigation, and checked by the team."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from dataclasses import dataclass
from math import inf, isfinite
from typing import TypeVar

from ..shared.domain.model import Point
from .protocol import (
    CRASHED,
    Crashed,
    DroneEvent,
    DroneSetup,
    DroneTelemetry,
    LinkLost,
    OutsideArea,
    Rejected,
    TargetTimeout,
)
from .timeouts import Lag, NavigationCalls

T = TypeVar("T")

_LOOK = 0.1
"""Seconds between two looks at a command that is carried out."""


class Reports:
    """The messages of one drone; used within the event loop only."""

    def __init__(self, setup: DroneSetup) -> None:
        self._id = setup.id
        self._silence = setup.silence
        self.telemetry = DroneTelemetry(
            time=-inf, position=setup.home, yaw=0.0, voltage=0.0, battery_level=1.0, flying=False
        )
        """The latest state."""
        self.crashed = ""
        """The reported reason of its crash, if any."""
        self._events: asyncio.Queue[DroneEvent | None] = asyncio.Queue()
        self._told = asyncio.Event()

    def tell(
        self,
        *,
        position: Point,
        flying: bool,
        yaw: float = 0.0,
        voltage: float = 0.0,
        battery_level: float | None = 1.0,
        crashed: str = "",
    ) -> None:
        """Take over a new state; `crashed` is the reason of a crash, or nothing; no level: it is not known."""
        self.telemetry = DroneTelemetry(
            time=time.monotonic(),
            position=position,
            yaw=yaw,
            voltage=voltage,
            battery_level=battery_level or 0.0,
            flying=flying,
            battery_told=battery_level is not None,
        )
        if crashed and not self.crashed:
            self.happened(CRASHED, crashed)
        self.crashed = crashed
        self._told.set()
        self._told = asyncio.Event()

    def from_thread(self, hear: Callable[[T], object]) -> Callable[[T], object]:
        """Wrap `hear`, so that any thread can have it called within the event loop."""
        loop = asyncio.get_running_loop()

        def hand_over(told: T) -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(hear, told)

        return hand_over

    def happened(self, kind: str, reason: str) -> None:
        self._events.put_nowait(DroneEvent(kind=kind, reason=reason))

    def refuse(self, target: Point, speed: float) -> None:
        """Raise if it cannot be sent there: an invalid place or speed, or it does not fly."""
        if not all(map(isfinite, target)) or target[2] < 0:
            raise OutsideArea(f"{self._id} cannot go to {target}")
        if not 0 < speed < inf:
            raise Rejected(f"{self._id} cannot fly at {speed} m/s")
        if not self.telemetry.flying:
            raise Rejected(f"{self._id} stands on the ground")

    async def until(self, done: Callable[[DroneTelemetry], bool], seconds: float) -> None:
        """Wait until a new state fulfils a condition.

        Raises `LinkLost` when it is silent, `Crashed` when it reports that, and `TargetTimeout` after
        the time-out.
        """
        began = time.monotonic()
        silent = self._silence
        lag = Lag()
        while self.telemetry.time <= began or not done(self.telemetry):
            now = time.monotonic()
            if self.crashed:
                raise Crashed(f"{self._id} has crashed: {self.crashed}")
            lag.called(now, now + _LOOK)
            since = max(began, self.telemetry.time)
            if now - since - lag.since(since, now) > silent:
                raise LinkLost(f"{self._id} has told nothing for {silent:g} s")
            if now - began > seconds:
                raise TargetTimeout(f"{self._id} is not there after {seconds:.0f} s")
            with suppress(TimeoutError):
                async with asyncio.timeout(_LOOK):
                    await self._told.wait()

    async def events(self) -> AsyncIterator[DroneEvent]:
        """Yield the events, until `close`."""
        while (event := await self._events.get()) is not None:
            yield event

    def close(self) -> None:
        self._events.put_nowait(None)


RISING = 3.0
"""Seconds after an aborted take-off until a drone is believed to be on the ground."""

EMPTY = 1.2
"""No drone flies for longer than this multiple of its flight time."""


@dataclass(frozen=True, slots=True)
class Sample:
    """A validated state of a drone."""

    time: float
    position: Point
    battery_level: float
    flying: bool


class VehicleTelemetry:
    """A drone's telemetry for all subscribers, always current.

    Before its first message it counts as being at home with an empty battery.
    """

    def __init__(
        self,
        home: Point,
        endurance: float,
        ask: Callable[[], DroneTelemetry],
        calls: NavigationCalls,
    ) -> None:
        self._home, self._endurance = home, endurance
        self._ask, self._calls = ask, calls
        self._raw: DroneTelemetry | None = None
        self._last: Sample | None = None
        self.flew = -inf
        """When it was last seen in the air."""
        self.rises_until = -inf
        """Until when it may be taking off without having reported it."""
        self.lag = Lag()
        """When nothing could be heard of it."""

    def look(self) -> Sample | None:
        """Return its latest state, or None."""
        raw = self._calls.ask("telemetry", self._ask, None)
        if raw is not None and raw is not self._raw:
            self._raw = raw
            sample = self._calls.ask("telemetry", lambda: _sample(raw), None)
            if sample is not None:
                self._last = sample
                if sample.flying:
                    self.flew = max(self.flew, sample.time)
                    self.rises_until = -inf
        return self._last

    @property
    def location(self) -> Point:
        last = self.look()
        return self._home if last is None else last.position

    @property
    def battery_level(self) -> float:
        last = self.look()
        return 0.0 if last is None else last.battery_level

    @property
    def is_rising(self) -> bool:
        """Whether it may have taken off without having reported it yet."""
        self.look()
        return self._calls.clock() < self.rises_until

    @property
    def landed(self) -> bool:
        last, now = self.look(), self._calls.clock()
        if now < self.rises_until:
            return False
        return last is None or not last.flying or now - last.time > EMPTY * self._endurance

    @property
    def silence(self) -> float:
        """Seconds since its last valid state in which it could have been heard."""
        last = self.look()
        now = self._calls.clock()
        return inf if last is None else now - last.time - self.lag.since(last.time, now)


def _sample(raw: DroneTelemetry) -> Sample | None:
    """Return its validated state; one without a position is invalid."""
    x, y, z = map(float, raw.position)
    time, level = float(raw.time), float(raw.battery_level)
    if not all(map(isfinite, (x, y, z, time, level))):
        return None
    return Sample(time, (x, y, z), min(1.0, max(0.0, level)), bool(raw.flying))
