"""The telemetry of a fleet, and its subscribers, each with a rate of its own."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from typing import Generic, Protocol, TypeVar

from ..shared.domain import model

V = TypeVar("V")


class Telemetry(model.Telemetry, Protocol):
    """The current state of a drone, and how old that is."""

    @property
    def silence(self) -> float:
        """Seconds since its last message; infinite: it has sent none."""


class Subscription(Generic[V]):
    """One subscriber to the drones' telemetry, inside a running asyncio loop, until it cancels."""

    def __init__(
        self,
        drones: Mapping[str, Telemetry],
        hear: Callable[[Mapping[str, V], float], object],
        *,
        every: float,
        view: Callable[[str, Telemetry], V],
        unchanged: float = 0.0,
    ) -> None:
        """`hear` is called at this interval with the drones that have changed, and how late that is.

        `drones` are always current; `view` returns what the subscriber wants to know about one. After
        `unchanged` seconds without any change `hear` is called with none.
        """
        self._drones, self._hear, self._view = drones, hear, view
        self._every, self._unchanged = every, unchanged
        self._told: dict[str, V] = {}
        """What the subscriber was last sent of each drone."""
        self._loop = asyncio.get_running_loop()
        self._told_at = self._loop.time()
        self._next()

    def changed(self) -> Mapping[str, V]:
        """Return what has changed since the last call; it counts as sent."""
        news = {drone: self._view(drone, known) for drone, known in self._drones.items()}
        news = {
            drone: value
            for drone, value in news.items()
            if drone not in self._told or value != self._told[drone]
        }
        self._told.update(news)
        return news

    def cancel(self) -> None:
        """End the subscription."""
        self._timer.cancel()

    def _next(self) -> None:
        self._due = self._loop.time() + self._every
        self._timer = self._loop.call_at(self._due, self._look)

    def _look(self) -> None:
        now = self._loop.time()
        late = now - self._due
        self._next()  # first, for a subscriber may cancel, or fail
        news = self.changed()
        if news or now - self._told_at >= self._unchanged:
            self._told_at = now
            self._hear(news, late)
