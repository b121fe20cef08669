"""Coroutines and time: one small kernel, driven by the wall's clock or by a virtual one.

Everything that happens is an event in one heap, ordered by (time, kind, key): simultaneous events
are taken in declared order, never by the accident of which task ran. Both drivers (`virtual.py`,
`realtime.py`) take events from the same heap, so the same coroutines run in simulation and for real.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Generator
from enum import IntEnum
from heapq import heappop, heappush
from typing import Any, Generic, TypeVar, cast

T = TypeVar("T")

Key = tuple[int, ...]
"""Who an event belongs to: the mission's place, then the branches'. Drones come after missions."""

FLEET: Key = (1 << 30,)
"""The key of what belongs to the fleet and to no mission."""


class Kind(IntEnum):
    """What is taken first of all that happens at one instant."""

    READY = 0  # a coroutine goes on: what has begun is finished first
    FLIGHT = 1  # navigation: at one instant the trip's own end comes before its timer
    TIMER = 2  # limits on flights
    CLOCK = 3  # delays and other waits
    ALLOCATE = 4  # last: all requests and all free drones of the instant are known


class Cancelled(BaseException):
    """Thrown into a coroutine that is no longer wanted."""


class ForeignAwait(RuntimeError):
    """A coroutine awaited what this kernel does not know."""


class Signal(Generic[T]):
    """Something that happens once. Await it for its value; any number of coroutines may."""

    __slots__ = ("_value", "_watchers", "error", "is_set")

    def __init__(self) -> None:
        self.is_set = False
        self._value: T | None = None
        self.error: BaseException | None = None
        self._watchers: list[Callable[[], None]] = []

    def set(self, value: T) -> None:
        """It happened. Only the first time counts."""
        if not self.is_set:
            self._value = value
            self._happened()

    def fail(self, error: BaseException) -> None:
        """It will never happen: whoever awaits it gets the error."""
        if not self.is_set:
            self.error = error
            self._happened()

    def _happened(self) -> None:
        self.is_set = True
        watchers, self._watchers = self._watchers, []
        for watcher in watchers:
            watcher()

    def watch(self, watcher: Callable[[], None]) -> None:
        """Call this when it happens; at once if it has."""
        if self.is_set:
            watcher()
        else:
            self._watchers.append(watcher)

    def unwatch(self, watcher: Callable[[], None]) -> None:
        """Do not call this after all."""
        if watcher in self._watchers:
            self._watchers.remove(watcher)

    @property
    def watched(self) -> bool:
        """Whether anybody waits for it."""
        return bool(self._watchers)

    def result(self) -> T:
        """Return the value, or raise the error; only once it is set."""
        if self.error is not None:
            raise self.error
        return cast(T, self._value)

    def __await__(self) -> Generator[Signal[Any], None, T]:
        if not self.is_set:
            yield self
        return self.result()


class Timer:
    """A call at a time to come."""

    __slots__ = ("call",)

    def __init__(self, call: Callable[[], None]) -> None:
        self.call: Callable[[], None] | None = call

    def cancel(self) -> None:
        """Do not call after all."""
        self.call = None


class Ending:
    """Keeps whatever something ends with, to be handed on to those who wait for it."""

    error: BaseException

    def __init__(self, passing: tuple[type[BaseException], ...] = (KeyboardInterrupt,)) -> None:
        self._passing = passing

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        if error is None or isinstance(error, self._passing):
            return False
        self.error = error
        return True


class Task(Generic[T]):
    """A coroutine on its way."""

    __slots__ = ("_coroutine", "_kernel", "_turn", "_waits_for", "done", "key", "name")

    def __init__(
        self, kernel: Kernel, coroutine: Coroutine[Any, Any, T], key: Key, name: str
    ) -> None:
        self._kernel, self._coroutine = kernel, coroutine
        self._waits_for: Signal[Any] | None = None
        self._turn: Timer | None = None
        self.key, self.name = key, name
        self.done: Signal[T] = Signal()
        kernel.tasks[self] = None

    def wake(self) -> None:
        """Go on, when its turn comes."""
        self._turn = self._kernel.at(self._kernel.now, Kind.READY, self.key, self._resume)

    def _resume(self) -> None:
        if not self.done.is_set:
            self._waits_for = None
            self._step(lambda: self._coroutine.send(None))

    def _step(self, advance: Callable[[], object]) -> None:
        """Let the coroutine run up to its next wait."""
        end = Ending((KeyboardInterrupt, SystemExit))
        with end:
            waits_for = advance()
            while not isinstance(waits_for, Signal):
                error = ForeignAwait(f"it awaited {type(waits_for).__name__}")
                waits_for = self._coroutine.throw(error)
            self._waits_for = waits_for
            waits_for.watch(self.wake)
            return
        del self._kernel.tasks[self]
        if isinstance(end.error, StopIteration):
            self.done.set(end.error.value)
            return
        if not isinstance(end.error, Cancelled) and not self.done.watched:
            self._kernel.crash(end.error)
        self.done.fail(end.error)

    def cancel(self) -> None:
        """Stop it where it waits, now."""
        if self.done.is_set:
            return
        if self._waits_for is not None:
            self._waits_for.unwatch(self.wake)
            self._waits_for = None
        if self._turn is not None:
            self._turn.cancel()  # it may wait once more, to clean up: not for this any longer
        self._step(lambda: self._coroutine.throw(Cancelled()))

    async def ended(self) -> None:
        """Wait until it is over, even if it is cancelled."""
        over: Signal[None] = Signal()
        self.done.watch(lambda: over.set(None))
        await over
        if not isinstance(self.done.error, Cancelled):
            self.done.result()

    def drop(self) -> None:
        """Forget it where it waits: the run is over."""
        self._coroutine.close()


class Kernel:
    """The heap of events, and the coroutines that wait for them."""

    def __init__(self) -> None:
        self._heap: list[tuple[float, int, Key, int, Timer]] = []
        self._count = 0
        self.tasks: dict[Task[Any], None] = {}
        self.crashed: BaseException | None = None

    @property
    def now(self) -> float:
        """Seconds since the start."""
        raise NotImplementedError

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight, local time."""
        raise NotImplementedError

    def at(self, when: float, kind: Kind, key: Key, call: Callable[[], None]) -> Timer:
        """Call this at a time; a time that has passed, or is none, means now."""
        timer = Timer(call)
        self._count += 1
        heappush(self._heap, (max(self.now, when), kind, key, self._count, timer))
        return timer

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Set a coroutine on its way; it begins when its turn comes."""
        task = Task(self, coroutine, key, name)
        task.wake()
        return task

    async def sleep(self, seconds: float, kind: Kind = Kind.CLOCK, key: Key = FLEET) -> None:
        """Wait for so many seconds."""
        over: Signal[None] = Signal()
        timer = self.at(self.now + seconds, kind, key, lambda: over.set(None))
        try:
            await over
        finally:
            timer.cancel()

    async def within(self, signal: Signal[Any], until: float, kind: Kind, key: Key) -> bool:
        """Wait until it happens or the time comes; say whether it has happened."""
        either: Signal[None] = Signal()

        def over() -> None:
            either.set(None)

        timer = self.at(until, kind, key, over)
        signal.watch(over)
        try:
            await either
        finally:
            timer.cancel()
            signal.unwatch(over)
        return signal.is_set

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook of the app's, `def` or `async def`, and return what it returns."""
        raise NotImplementedError

    def offer(self, signal: Signal[T]) -> Coroutine[Any, Any, T]:
        """Return what a hook may await for this signal."""
        raise NotImplementedError

    def crash(self, error: BaseException) -> None:
        """Remember an error that no coroutine caught: the driver stops and raises it."""
        if self.crashed is None:
            self.crashed = error

    def close(self) -> None:
        """Drop what still waits; nothing of it runs on."""
        for task in list(self.tasks):
            task.drop()

    def next_time(self) -> float | None:
        """Return the time of the next event; None: nothing will ever happen."""
        while self._heap and self._heap[0][4].call is None:
            heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def take(self) -> None:
        """Take the next event; there is one."""
        timer = heappop(self._heap)[4]
        call, timer.call = timer.call, None
        if call is not None:
            call()
