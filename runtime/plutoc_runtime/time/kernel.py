"""Coroutines and time: one small event loop, driven by the real clock or by a virtual one.

Everything that happens is an event, ordered by (time, kind, key), so simultaneous events are
processed in a declared order, whichever task ran first. A brain and the library process events with
the same `drain`, in virtual time and in real time.

Resumed coroutines and the queue for drones are by far the most frequent events, and they belong to
the current instant: they bypass the heap of future events.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from enum import IntEnum
from gc import unfreeze
from heapq import heappop, heappush
from typing import Any, TypeVar

from ..domain.errors import ANY_ERROR, Cancelled
from .future import Future

T = TypeVar("T")

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

    READY = 0  # a coroutine resumes: what has begun is finished first; see `Kernel.ready`
    FLIGHT = 1  # what drones do: a trip that ends at its time-out has ended first
    TIMER = 2  # limits on flights
    CLOCK = 3  # delays and other waits
    ALLOCATE = 4  # all requests and all free drones are known; before these, `Kernel.at_the_end`


class ForeignAwait(RuntimeError):
    """A coroutine awaited something other than a `Future` of this kernel."""


Call = Callable[[], object]


class Timer:
    """A scheduled call that can be cancelled."""

    __slots__ = ("_call",)

    def __init__(self, call: Call) -> None:
        self._call: Call | None = call

    def __call__(self) -> None:
        if self._call is not None:
            self._call()

    @property
    def cancelled(self) -> bool:
        """Whether it was cancelled."""
        return self._call is None

    def cancel(self) -> None:
        """Cancel the call; after it was made this does nothing."""
        self._call = None


class Task(Future[T]):
    """A running coroutine; as a future it is set when the coroutine ends."""

    __slots__ = ("_kernel", "_waits_for", "coroutine", "key", "name", "over", "turn")

    def __init__(
        self, kernel: Kernel, coroutine: Coroutine[Any, Any, T], key: Key, name: str
    ) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self._kernel, self.coroutine, self.key, self.name = kernel, coroutine, key, name
        self._waits_for: Future[Any] | None = None
        self.turn = 0
        """The number of the wake-up that may resume it; older ones are ignored. 0: none is pending."""
        self.over: Callable[[Task[T]], None] | None = None
        """Called when it has ended, in any way; without it, an unobserved error stops the run."""
        kernel.tasks[self] = None

    def wake(self, _: object = None) -> None:
        """Resume at the current instant, in order of key."""
        kernel = self._kernel
        kernel.count = self.turn = turn = kernel.count + 1
        heappush(kernel.ready, (self.key, turn, self))

    def step(self, error: BaseException | None = None) -> None:
        """Run the coroutine up to its next `await`; an error is raised where it waits."""
        coroutine = self.coroutine
        try:
            waits_for = coroutine.send(None) if error is None else coroutine.throw(error)
            while not isinstance(waits_for, Future):
                foreign = ForeignAwait(f"it awaited {type(waits_for).__name__}")
                waits_for = coroutine.throw(foreign)
        except StopIteration as end:
            returned: T = end.value
        except KeyboardInterrupt:
            raise
        except ANY_ERROR as raised:
            self._leave()
            if not (isinstance(raised, Cancelled) or self.waiter or self._watchers or self.over):
                self._kernel.crash(raised)
            self.fail(raised)
            if self.over is not None:
                self.over(self)
            return
        else:
            self._waits_for = waits_for
            if waits_for.waiter is None:
                waits_for.waiter = self
            else:
                waits_for.watch(self.wake)
            return
        self._leave()
        self.set(returned)
        if self.over is not None:
            self.over(self)

    def _leave(self) -> None:
        self.turn, self._waits_for = 0, None
        self._kernel.tasks.pop(self, None)

    def cancel(self) -> None:
        """Raise `Cancelled` where it waits, at once."""
        if not self.is_set:
            self._wait_no_longer()
            self.step(Cancelled())

    def _wait_no_longer(self) -> None:
        waits_for, self._waits_for = self._waits_for, None
        if waits_for is not None:
            waits_for.unwatch(self.wake)
            if waits_for.waiter is self:
                waits_for.waiter = None
        self.turn = 0  # while cleaning up it may wait again, for something else

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
        self._kernel.tasks.pop(self, None)
        self.coroutine.close()


class Kernel:
    """The future events, and the coroutines that wait for them."""

    def __init__(self) -> None:
        self.now = 0.0  # the current instant, in seconds since the start
        self.tasks: dict[Task[Any], None] = {}
        """The coroutines that have not ended, in the order in which they were started."""
        self.crashed: BaseException | None = None
        self.over = False
        """The run's goal is reached, or something crashed: no further event is processed."""
        self.count = 0
        """How many events were scheduled; it breaks ties: first scheduled, first processed."""
        self.ready: list[tuple[Key, int, Task[Any]]] = []
        """The coroutines to resume at this instant, with the number of their wake-up."""
        self.at_the_end: Callable[[], object] | None = None
        """Called when all else of this instant is done: serves the fleet's queue."""
        self.settled: Callable[[], object] | None = None
        """Called when an instant has been processed: writes its events to the journal."""
        self._heap: list[tuple[float, int, Key, int, Call]] = []

    def time(self) -> float:
        """Return the seconds since the start; between events it is later than `now`."""
        return self.now

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Schedule a call that can be cancelled; a time in the past means now."""
        timer = Timer(call)
        self.schedule(when, kind, key, timer)
        return timer

    def schedule(self, when: float, kind: EventKind, key: Key, call: Call) -> None:
        """Schedule a call; a time in the past, or not a number, means now."""
        self.count = count = self.count + 1
        if not when > self.now:
            when = self.now
        heappush(self._heap, (when, kind, key, count, call))

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Start a coroutine; it runs for the first time at this instant, in order of key."""
        task = Task(self, coroutine, key, name)
        task.wake()
        return task

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
        if self.ready or self.at_the_end is not None:
            return self.now
        heap = self._heap
        while heap and isinstance(heap[0][4], Timer) and heap[0][4].cancelled:
            heappop(heap)
        return heap[0][0] if heap else None

    def drain(self, until_any: Sequence[object] = ()) -> None:
        """Process all events of this instant in order, also those that they cause.

        First the coroutines that are ready; then, unless `until_any` has got an element meanwhile, what
        the heap has due; then `at_the_end`, and last what is of the kind ALLOCATE.
        """
        heap, ready, now = self._heap, self.ready, self.now
        while not self.over:
            if ready:
                _, turn, task = heappop(ready)
                if turn == task.turn:
                    task.turn = 0
                    task.step()
            elif until_any:
                return
            elif heap and heap[0][0] <= now and (heap[0][1] < _LAST or self.at_the_end is None):
                heappop(heap)[4]()
            elif self.at_the_end is not None:
                serve, self.at_the_end = self.at_the_end, None
                serve()
            else:
                return


_LAST = int(EventKind.ALLOCATE)
