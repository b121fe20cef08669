"""The context that a hook gets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.text import class_of, text_of
from ..time.future import Future
from ..time.kernel import EventKind, Kernel, mission_key

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from ..domain.results import Result, ResultStore
    from .live_drone import LiveDrone


class LatestFlight(Protocol):
    """The mission's latest flight: a future that is set when its trip has ended."""

    trip: Trip
    is_set: bool

    def watch(self, watcher: Callable[[Any], object]) -> None: ...
    def unwatch(self, watcher: Callable[[Any], object]) -> None: ...


class Context:
    """The running app, for an action or a modifier. Times are seconds since the start."""

    __slots__ = ("_kernel", "_latest", "_live", "_log", "_mission", "_results")

    def __init__(
        self,
        kernel: Kernel,
        results: ResultStore,
        log: Callable[[str, str], None],
        mission: Mission[Any],
        latest: Callable[[], LatestFlight | None],
        live: LiveDrone | None = None,
    ) -> None:
        self._kernel, self._results, self._log = kernel, results, log
        self._mission, self._latest, self._live = mission, latest, live

    @property
    def now(self) -> float:
        """The time, in seconds since the app started."""
        return self._kernel.time()

    @property
    def results(self) -> Sequence[Result[Any, Any]]:
        """The results of all actions of the app so far."""
        return self._results.so_far()

    def log(self, text: str) -> None:
        """Write a line on the console."""
        self._log(text_of(text, f"<{class_of(text)}>"), self._mission.name)

    def live(self, drone: Drone) -> LiveDrone:
        """Return the drone of this action, whose sensors can be read and parameters set while it hovers."""
        live = self._live
        if live is None:
            raise RuntimeError("only an action that is an `async def` has a live drone")
        if not live.is_of(drone):
            raise RuntimeError(f"{drone.id} does not do this action")
        return live

    async def sleep(self, seconds: float) -> None:
        """Wait this many seconds, simulated or real."""
        await self._wait(Future(), self.now + _finite(seconds), EventKind.CLOCK)

    async def trip_ended(self, trip: Trip, *, within: float | None = None) -> bool:
        """Wait until a trip of this mission has ended; return whether it has.

        With `within`, wait no longer than so many seconds from the trip's start: False means that
        it is still flying. At the very same instant the trip's own end wins.
        """
        flight, over = self._latest(), Future[object]()
        if trip.ended or flight is None or flight.trip is not trip:
            return trip.ended
        until = None if within is None else (trip.start_time or 0.0) + _finite(within)
        flight.watch(over.set)
        try:
            await self._wait(over, until, EventKind.TIMER)
        finally:
            flight.unwatch(over.set)
        return flight.is_set

    async def _wait(self, over: Future[Any], until: float | None, kind: EventKind) -> None:
        """Wait for something, but no longer than until then."""
        timer = None
        if until is not None:
            key = mission_key(self._mission.index)
            timer = self._kernel.at(until, kind, key, partial(over.set, None))
        try:
            await self._kernel.offer(over)
        finally:
            if timer is not None:
                timer.cancel()


def _finite(seconds: float) -> float:
    """Return seconds to wait; a hook that waits for ever would keep its mission for ever."""
    if not isfinite(seconds):
        raise ValueError(f"{seconds} seconds is no time to wait for")
    return seconds
