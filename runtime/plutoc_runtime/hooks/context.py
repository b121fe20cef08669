"""The context that a hook gets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.text import class_of, text_of
from ..time.future import Future
from ..time.kernel import EventKind, Kernel, Key, mission_key

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from ..domain.results import Result, ResultStore
    from .live_drone import LiveDrone


class LatestFlight(Protocol):
    """The mission's latest flight: a future that is set when its trip has ended."""

    trip: Trip
    is_set: bool

    def watch(self, watcher: Callable[[Any], object]) -> None:
        """Call this when it has ended."""

    def unwatch(self, watcher: Callable[[Any], object]) -> None:
        """Remove a watcher."""


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
        kernel, over = self._kernel, Future[None]()
        _must_be_finite(seconds)
        timer = kernel.at(
            kernel.time() + seconds, EventKind.CLOCK, self._key, lambda: over.set(None)
        )
        try:
            await kernel.offer(over)
        finally:
            timer.cancel()

    async def trip_ended(self, trip: Trip, *, within: float | None = None) -> bool:
        """Wait until a trip of this mission has ended; return whether it has.

        With `within`, wait no longer than so many seconds from the trip's start: False means that
        it is still flying. At the very same instant the trip's own end wins.
        """
        flight = self._latest()
        if trip.ended or flight is None or flight.trip is not trip:
            return trip.ended
        kernel, over = self._kernel, Future[None]()

        def wake(_: object = None) -> None:
            over.set(None)

        flight.watch(wake)
        timer = None
        if within is not None:
            _must_be_finite(within)
            until = (trip.start_time or 0.0) + within
            timer = kernel.at(until, EventKind.TIMER, self._key, wake)
        try:
            await kernel.offer(over)
        finally:
            flight.unwatch(wake)
            if timer is not None:
                timer.cancel()
        return flight.is_set

    @property
    def _key(self) -> Key:
        return mission_key(self._mission.index)


def _must_be_finite(seconds: float) -> None:
    """A hook that waits for ever would keep its mission for ever."""
    if not isfinite(seconds):
        raise ValueError(f"{seconds} seconds is no time to wait for")
