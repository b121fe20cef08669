"""What hooks see: the context, the live drone, the results, and the verdict of an evaluator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from inspect import iscoroutinefunction, unwrap
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ..domain.errors import ActionFailed, FlightFailed
from ..domain.keeper import put
from ..domain.model import NO_RESULT, Result, Results
from ..domain.plain import number_of
from ..domain.text import class_of, text_of
from ..time.kernel import EventKind, Future, mission_key
from .calls import offer

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Point, ResultStore, Trip
    from ..time.kernel import Key, Task
    from ..time.told import ToldTime


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
        kernel: ToldTime,
        results: ResultStore,
        log: Callable[[str, str], None],
        mission: Mission[Any],
        latest: Callable[[], LatestFlight | None],
        live: LiveDrone | None = None,
    ) -> None:
        self._kernel = kernel
        self._results = results
        self._log = log
        self._mission = mission
        self._latest = latest
        self._live = live

    @property
    def now(self) -> float:
        """The time, in seconds since the app started."""
        return self._kernel.time()

    @property
    def results(self) -> Sequence[Result[Any, Any]]:
        """The results of all actions of the app so far."""
        return View(self._results.results)

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
        flight = self._latest()
        over = Future[object]()
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
            timer = self._kernel.post(self._kernel.at, until, kind, key, partial(over.set, None))
        try:
            await offer(self._kernel, over)
        finally:
            if timer is not None:
                timer.cancel()


def _finite(seconds: float) -> float:
    """Return seconds to wait; a hook that waits for ever would keep its mission for ever."""
    plain = number_of(seconds)
    if plain is None:
        raise ValueError(f"{seconds} seconds is no time to wait for")
    return plain


class Instruments(Protocol):
    """Gives orders to a hovering drone, such as to `read` or to `write` a value."""

    async def ask(self, do: str, drone: str, *, name: str, value: float = ...) -> Any: ...


class LiveDrone:
    """The drone of an action: its sensors, and the parameters that can be set.

    Raises `ActionFailed` for a name that the drone does not have, or if it cannot be reached.
    """

    __slots__ = ("_drone", "_is_over", "_kernel", "_key", "_orders")

    def __init__(self, kernel: ToldTime, orders: Instruments, drone: Drone, key: Key) -> None:
        self._kernel = kernel
        self._orders = orders
        self._drone = drone
        self._key = key
        self._is_over = False

    @property
    def position(self) -> Point:
        """Where it is now: metres in the map's frame."""
        return self._now.location

    @property
    def battery(self) -> float:
        """The charge of its battery, from 0 to 1."""
        return self._now.battery_level

    async def read(self, name: str) -> float:
        """Return the current value of a sensor or variable, such as `range.front`."""
        _must_be_a_name(name)
        return float(await self._asked("read", name))

    async def write(self, name: str, value: float) -> None:
        """Set a parameter; returns when the drone has it."""
        _must_be_a_name(name)
        number = float(value)
        if not isfinite(number):
            raise ValueError(f"{name} cannot be set to {number}")
        await self._asked("write", name, value=number)

    def release(self) -> None:
        """End the access to the drone: the action has ended."""
        self._is_over = True

    def is_of(self, drone: Drone) -> bool:
        """Return whether it is this drone."""
        return drone is self._drone

    @property
    def _now(self) -> Drone:
        if self._is_over:
            raise RuntimeError(f"the action of {self._drone.id} is over: it does other things now")
        return self._drone

    async def _asked(self, do: str, name: str, **more: float) -> Any:
        """Give the order within the kernel, and wait for the answer in a hook."""
        kernel = self._kernel
        drone = self._now.id

        def begin() -> Task[Any]:
            asks = self._orders.ask(do, drone, name=name, **more)
            task = kernel.spawn(asks, self._key, f"{drone} is asked for {name}")
            task.over = lambda _: None  # an error is told to the hook, not to the kernel
            return task

        asking = kernel.post(begin)
        try:
            return await offer(kernel, asking)
        except FlightFailed as error:
            raise ActionFailed(str(error)) from error
        finally:
            if not asking.is_set:
                kernel.post(asking.cancel)


def can_wait(hook: Callable[..., object]) -> bool:
    """Return whether this is an `async def`, decorated or not."""
    inner = unwrap(getattr(hook, "func", hook))  # a partial carries its function
    return iscoroutinefunction(inner)


_LONGEST = 100
"""Characters of a name."""


def _must_be_a_name(name: str) -> None:
    if not isinstance(name, str) or not 0 < len(name) <= _LONGEST:
        raise ValueError(f"what a drone is asked for is a text of 1 to {_LONGEST} characters")


class View(Sequence[Result[Any, Any]]):
    """The results so far, read-only: nothing is copied for each evaluation."""

    def __init__(self, results: Sequence[Result[Any, Any]]) -> None:
        self._results = results
        self._count = len(results)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: Any) -> Any:
        picked = range(self._count)[index]  # an IndexError is its own
        if isinstance(picked, range):
            return tuple(self._results[number] for number in picked)
        return self._results[picked]

    def __repr__(self) -> str:
        return repr(tuple(self))


def results_for(store: ResultStore, mission: Mission[Any]) -> Results[Any, Any]:
    """Return what a mission's evaluator gets now; what is new is old from then on."""
    new: list[Result[Any, Any]] = []
    last = mission.last_result
    put(mission, last_result=NO_RESULT)
    while last != NO_RESULT:
        new.append(store.results[last])
        last = store.before[last]
    return Results(tuple(reversed(new)), View(store.results))


class Verdict(NamedTuple):
    """An evaluator's verdict; the runtime sets the mission's status from it."""

    ok: bool = True
    """False with nothing to redo and nothing to add: the mission has FAILED."""
    redo: Sequence[Trip] = ()
    """Completed trips of this mission that must be flown again."""
    add: Sequence[Trip] = ()
    """New trips for this mission; they are not repeated by a later round."""
    log: Sequence[str] = ()
    """Lines for the console."""
    fail: str | None = None
    """The mission has FAILED, and this is why."""
