"""What is known of a real drone: the last that made sense of what it told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .telemetry import DroneTelemetry
    from .timeouts import Calls

RISING = 3.0
"""Seconds after a take-off that was broken off until a drone is believed to stand on the ground."""

EMPTY = 1.2
"""Nothing flies for longer than so many times its flight time."""


@dataclass(frozen=True, slots=True)
class Sample:
    """What a drone told at one moment, all of it checked."""

    time: float
    position: Point
    battery_level: float
    flying: bool


class Seen:
    """A drone's telemetry, for all who want to know: it stays current.

    Before its first word it stands at home, with nothing in its battery.
    """

    def __init__(
        self,
        home: Point,
        flight_time: float,
        ask: Callable[[], DroneTelemetry],
        calls: Calls,
    ) -> None:
        self._home, self._flight_time = home, flight_time
        self._ask, self._calls = ask, calls
        self._raw: DroneTelemetry | None = None
        self._last: Sample | None = None
        self.flew = -inf
        """When it was last seen in the air."""
        self.rises_until = -inf
        """Until when it may be rising though it has not said so."""

    def look(self) -> Sample | None:
        """Return the last it told; None: nothing yet."""
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
        """Where it is."""
        last = self.look()
        return self._home if last is None else last.position

    @property
    def battery_level(self) -> float:
        """What is left in its battery, from 0 to 1."""
        last = self.look()
        return 0.0 if last is None else last.battery_level

    @property
    def is_rising(self) -> bool:
        """Whether it may have taken off, and has not said so yet."""
        self.look()
        return self._calls.clock() < self.rises_until

    @property
    def landed(self) -> bool:
        """Whether it is on the ground; who was silent for longer than it can fly must be."""
        last, now = self.look(), self._calls.clock()
        if now < self.rises_until:
            return False
        return last is None or not last.flying or now - last.time > EMPTY * self._flight_time

    @property
    def silence(self) -> float:
        """Seconds since it last told anything that made sense."""
        last = self.look()
        return inf if last is None else self._calls.clock() - last.time


def _sample(raw: DroneTelemetry) -> Sample | None:
    """Return what makes sense of it; a drone that does not know where it is has told nothing."""
    x, y, z = map(float, raw.position)
    time, level = float(raw.time), float(raw.battery_level)
    if not all(map(isfinite, (x, y, z, time, level))):
        return None
    return Sample(time, (x, y, z), min(1.0, max(0.0, level)), bool(raw.flying))
