"""Coroutines and time: one small event loop, driven by the real clock or by a virtual one.

Everything that happens is an event, ordered by (time, kind, key), so simultaneous events are
processed in a declared order, whichever task ran first. A brain and the library process events with
the same `drain`, in virtual time and in real time.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Generator, Sequence
from enum import IntEnum
from gc import unfreeze
from heapq import heappop, heappush
from itertools import count
from math import inf
from typing import Any, Generic, TypeVar, cast

from ..domain.errors import Cancelled

T = TypeVar("T")

Call = Callable[[], object]
Watcher = Callable[[Any], object]  # called with a future when it is set

Key = int
"""The owner of an event: the mission's index, then the branches'. Drones come after missions.

A number and not a tuple: events are compared all the time.
"""

_BRANCH, _DEPTH = 10, 4
"""Bits for a branch's number, and how deep forks may nest before branches share a key."""

FLEET: Key = 1 << 96  # the key of events that belong to the fleet and not to a mission


def mission_key(index: int) -> Key:
    """Return the key of the mission with this index in its file."""
    return index << (_BRANCH * _DEPTH)


def branch_key(key: Key, number: int, depth: int) -> Key:
    """Return the key of a branch below this key; `depth` counts the forks around it."""
    room = (1 << _BRANCH) - 1
    return key + (min(number + 1, room) << (_BRANCH * (_DEPTH - depth))) if depth <= _DEPTH else key


class EventKind(IntEnum):
    """The order in which simultaneous events are processed."""

    READY = 0  # a coroutine resumes: what has begun is finished first
    FLIGHT = 1  # what drones do: a trip that ends at its time-out has ended first
    TIMER = 2  # limits on flights
    CLOCK = 3  # delays and other waits
    SERVE = 4  # the queue for drones: all requests and all free drones are known
    ALLOCATE = 5  # what must come after that


class ForeignAwait(RuntimeError):
    """A coroutine awaited something other than a `Future` of this kernel."""


class Future(Generic[T]):
    """A value that is set once; any number of coroutines may await it."""

    __slots__ = ("_value", "_watchers", "error", "is_set")

    def __init__(self) -> None:
        self.is_set = False
        self.error: BaseException | None = None
        self._value: Any = None
        self._watchers: list[Watcher] | None = None
        """Those that wait, in their order; most futures never have any."""

    def set(self, value: T) -> None:
        """Set the value; only the first call counts."""
        if self.is_set:
            return
        self.is_set = True
        self._value = value
        watchers = self._watchers
        if watchers is not None:
            self._watchers = None
            for watcher in watchers:
                watcher(self)

    def fail(self, error: BaseException) -> None:
        """Set an error, which is raised wherever it is awaited; only the first call counts."""
        if not self.is_set:
            self.error = error
            self.set(cast("T", None))

    def watch(self, watcher: Watcher) -> None:
        """Call this with the future when it is set; at once if it is."""
        if self.is_set:
            watcher(self)
        elif self._watchers is None:
            self._watchers = [watcher]
        else:
            self._watchers.append(watcher)

    def unwatch(self, watcher: Watcher) -> None:
        """Remove a watcher; one that is not there is ignored."""
        if self._watchers is not None and watcher in self._watchers:
            self._watchers.remove(watcher)

    def result(self) -> T:
        """Return the value, or raise the error; only once it is set."""
        if self.error is not None:
            raise self.error
        value: T = self._value
        return value

    def __await__(self) -> Generator[Future[Any], None, T]:
        if not self.is_set:
            yield self
        if self.error is not None:
            raise self.error
        value: T = self._value
        return value


class Timer:
    """A scheduled call that can be cancelled."""

    __slots__ = ("_call",)

    def __init__(self, call: Call) -> None:
        self._call: Call | None = call

    @property
    def cancelled(self) -> bool:
        """Whether it was cancelled."""
        return self._call is None

    def cancel(self) -> None:
        """Cancel the call; after it was made this does nothing."""
        self._call = None

    def happen(self, _: int) -> None:
        """Make the call."""
        if self._call is not None:
            self._call()


class Task(Future[T]):
    """A running coroutine; as a future it is set when the coroutine ends."""

    __slots__ = ("_kernel", "_turn", "_waits_for", "coroutine", "key", "name", "over")

    def __init__(
        self, kernel: Kernel, coroutine: Coroutine[Any, Any, T], key: Key, name: str
    ) -> None:
        super().__init__()
        self._kernel = kernel
        self.coroutine = coroutine
        self.key = key
        self.name = name
        self._waits_for: Future[Any] | None = None
        self._turn = 0
        """The number of the event that resumes it; any other is of a wait that was cancelled."""
        self.over: Callable[[Task[T]], None] | None = None
        """Called when it has ended, in any way; without it, an unobserved error stops the run."""
        kernel.tasks[self] = None
        self.wake()

    def wake(self, _: object = None) -> None:
        """Resume at the current instant, in order of key."""
        kernel = self._kernel
        self._turn = turn = next(kernel.numbers)
        heappush(kernel.heap, (_BEFORE_ALL, _READY, self.key, turn, self))

    def happen(self, turn: int, error: BaseException | None = None) -> None:
        """Run the coroutine up to its next `await`, if it is its turn; an error is raised where it waits."""
        if turn != self._turn:
            return
        coroutine = self.coroutine
        try:
            waits_for = coroutine.send(None) if error is None else coroutine.throw(error)
            while not isinstance(waits_for, Future):
                foreign = ForeignAwait(f"it awaited {type(waits_for).__name__}")
                waits_for = coroutine.throw(foreign)
        except StopIteration as end:
            self._leave()
            self.set(end.value)
        except KeyboardInterrupt:
            raise
        except BaseException as raised:  # noqa: BLE001 - it is raised in the task that awaits this
            self._leave()
            if not (isinstance(raised, Cancelled) or self._watchers or self.over):
                self._kernel.crash(raised)
            self.fail(raised)
        else:
            self._waits_for = waits_for
            waits_for.watch(self.wake)
            return
        if self.over is not None:
            self.over(self)

    def cancel(self) -> None:
        """Raise `Cancelled` where it waits, at once."""
        if not self.is_set:
            self._wait_no_longer()
            self.happen(self._turn, Cancelled())

    async def ended(self) -> None:
        """Wait until it has ended; a cancellation is no error here."""
        over: Future[None] = Future()
        self.watch(lambda _: over.set(None))
        await over
        if not isinstance(self.error, Cancelled):
            self.result()

    def drop(self) -> None:
        """Close the coroutine where it waits, without waking anything: the run is over."""
        self._wait_no_longer()
        self._leave()
        self.coroutine.close()

    def _wait_no_longer(self) -> None:
        if self._waits_for is not None:
            self._waits_for.unwatch(self.wake)
            self._waits_for = None
        self._turn = 0  # while cleaning up it may wait again, for something else

    def _leave(self) -> None:
        self._waits_for = None
        self._kernel.tasks.pop(self, None)


class Kernel:
    """The future events, and the coroutines that wait for them."""

    def __init__(self) -> None:
        self.now = 0.0  # the current instant, in seconds since the start
        self.tasks: dict[Task[Any], None] = {}
        """The coroutines that have not ended, in the order in which they were started."""
        self.crashed: BaseException | None = None
        self.over = False
        """The run's goal is reached, or something crashed: no further event is processed."""
        self.settled: Callable[[], object] | None = None
        """Called when an instant has been processed: writes its events to the journal."""
        self.numbers = count(1)
        """Of the events, as they are scheduled: they break ties, first scheduled, first processed."""
        self.heap: list[tuple[float, int, Key, int, Timer | Task[Any]]] = []
        """Time, kind, key and number of each event, and what happens. What is ready comes before
        all that has a time, even if that is overdue."""

    def time(self) -> float:
        """Return the seconds since the start; between events it is later than `now`."""
        return self.now

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Schedule a call; a time in the past, or not a number, means now."""
        timer = Timer(call)
        due = max(self.now, when)
        heappush(self.heap, (due, kind, key, next(self.numbers), timer))
        return timer

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Start a coroutine; it runs for the first time at this instant, in order of key."""
        return Task(self, coroutine, key, name)

    async def sleep(
        self, seconds: float, kind: EventKind = EventKind.CLOCK, key: Key = FLEET
    ) -> None:
        """Wait this many seconds."""
        await self.within(Future(), self.now + seconds, kind, key)

    async def within(self, future: Future[Any], until: float, kind: EventKind, key: Key) -> bool:
        """Wait until the future is set or the time comes; return whether it was set."""
        either: Future[None] = Future()

        def over(_: object = None) -> None:
            either.set(None)

        timer = self.at(until, kind, key, over)
        future.watch(over)
        try:
            await either
        finally:
            timer.cancel()
            future.unwatch(over)
        return future.is_set

    def post(self, call: Callable[..., object], *args: object) -> object:
        """Deliver something from outside: an answer of a drone, a hook or a person."""
        return call(*args)

    def crash(self, error: BaseException) -> None:
        """Stop the run with an error that no coroutine has caught; the driver raises it."""
        if self.crashed is None:
            self.crashed = error
        self.over = True

    def close(self) -> None:
        """Close all coroutines that still wait."""
        for task in tuple(self.tasks):
            task.drop()
        unfreeze()

    def next_time(self) -> float | None:
        """Return the time of the next event; None: there will be none."""
        heap = self.heap
        while heap and isinstance(timer := heap[0][4], Timer) and timer.cancelled:
            heappop(heap)
        return max(heap[0][0], self.now) if heap else None

    def drain(self, until_any: Sequence[object] = ()) -> None:
        """Process all events of this instant in order, also those that they cause.

        Once `until_any` has got an element, only coroutines that are ready.
        """
        heap = self.heap
        now = self.now
        while heap and heap[0][0] <= (_BEFORE_ALL if until_any else now) and not self.over:
            _, _, _, number, event = heappop(heap)
            event.happen(number)


_READY = int(EventKind.READY)
_BEFORE_ALL = -inf
