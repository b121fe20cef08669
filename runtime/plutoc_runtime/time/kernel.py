"""Coroutines and time: one small kernel, driven by the wall's clock or by a virtual one.

Everything that happens is an event, ordered by (time, kind, key): simultaneous events are taken in
declared order, never by the accident of which task ran. Both drivers (`virtual.py`, `realtime.py`)
take events by the same `drain`, so the same coroutines run in simulation and for real.

Coroutines that go on and the queue for drones are by far the most frequent events, and they belong
to the instant that is being taken: they need not pass through the heap of all that is to come.
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
"""Who an event belongs to: the mission's place, then the branches'. Drones come after missions.

A number and not a tuple: events are compared all the time.
"""

_BRANCH, _DEPTH = 10, 4
"""Bits for a branch's number, and how deep forks may nest before branches share their places."""

FLEET: Key = 1 << 96
"""The key of what belongs to the fleet and to no mission."""


def mission_key(index: int) -> Key:
    """Return the key of the mission with this place in its file."""
    return index << (_BRANCH * _DEPTH)


def branch_key(key: Key, number: int, depth: int) -> Key:
    """Return the key of a branch, at a depth of forks, of what has this key."""
    room = (1 << _BRANCH) - 1
    return key + (min(number + 1, room) << (_BRANCH * (_DEPTH - depth))) if depth <= _DEPTH else key


class EventKind(IntEnum):
    """What is taken first of all that happens at one instant."""

    READY = 0  # a coroutine goes on: what has begun is finished first
    FLIGHT = 1  # navigation: at one instant the trip's own end comes before its timer
    TIMER = 2  # limits on flights
    CLOCK = 3  # delays and other waits
    ALLOCATE = 4  # last: all requests and all free drones of the instant are known


class ForeignAwait(RuntimeError):
    """A coroutine awaited what this kernel does not know."""


Call = Callable[[], object]


class Timer:
    """A call at a time to come that can still be cancelled."""

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
        """Do not call after all."""
        self._call = None


class Task(Future[T]):
    """A coroutine on its way; it is set when the coroutine ends."""

    __slots__ = (
        "_coroutine",
        "_kernel",
        "_waits_for",
        "key",
        "name",
        "over",
        "turn",
    )

    def __init__(
        self, kernel: Kernel, coroutine: Coroutine[Any, Any, T], key: Key, name: str
    ) -> None:
        self.is_set = False
        self.error = self.waiter = self._value = self._watchers = None
        self._kernel, self._coroutine = kernel, coroutine
        self._waits_for: Future[Any] | None = None
        self.turn = 0
        """The number of its next turn; another one is not its any longer. 0: it waits for none."""
        self.key, self.name = key, name
        self.over: Callable[[Task[T]], None] | None = None
        """Told when it has ended, however it has; without a listener an error stops the run."""
        kernel.tasks[self] = None

    @property
    def coroutine(self) -> Coroutine[Any, Any, T]:
        """What it is that goes on: to see where it waits."""
        return self._coroutine

    def wake(self, _: object = None) -> None:
        """Go on, when its turn comes."""
        kernel = self._kernel
        kernel.count = self.turn = turn = kernel.count + 1
        heappush(kernel.ready, (self.key, turn, self))

    def step(self) -> None:
        """Let the coroutine run up to its next wait."""
        try:
            waits_for = self._coroutine.send(None)
        except StopIteration as end:
            returned: T = end.value
        except KeyboardInterrupt:
            raise
        except ANY_ERROR as error:
            self._failed(error)
            return
        else:
            if isinstance(waits_for, Future):
                self._waits_for = waits_for
                if waits_for.waiter is None:
                    waits_for.waiter = self
                else:
                    waits_for.watch(self.wake)
            else:
                self._throw(ForeignAwait(f"it awaited {type(waits_for).__name__}"))
            return
        self._returned(returned)

    def _throw(self, error: BaseException) -> None:
        """Let the coroutine run on from an error."""
        try:
            waits_for = self._coroutine.throw(error)
            while not isinstance(waits_for, Future):
                foreign = ForeignAwait(f"it awaited {type(waits_for).__name__}")
                waits_for = self._coroutine.throw(foreign)
        except StopIteration as end:
            returned: T = end.value
        except KeyboardInterrupt:
            raise
        except ANY_ERROR as ended:
            self._failed(ended)
            return
        else:
            self._waits_for = waits_for
            waits_for.watch(self.wake)
            return
        self._returned(returned)

    def _returned(self, value: T) -> None:
        self._leave()
        self.set(value)
        if self.over is not None:
            self.over(self)

    def _failed(self, error: BaseException) -> None:
        self._leave()
        if not (isinstance(error, Cancelled) or self.watched or self.over):
            self._kernel.crash(error)
        self.fail(error)
        if self.over is not None:
            self.over(self)

    def _leave(self) -> None:
        self.turn, self._waits_for = 0, None
        self._kernel.tasks.pop(self, None)

    def cancel(self) -> None:
        """Stop it where it waits, now."""
        if not self.is_set:
            self._wait_no_longer()
            self._throw(Cancelled())

    def _wait_no_longer(self) -> None:
        waits_for, self._waits_for = self._waits_for, None
        if waits_for is not None:
            waits_for.unwatch(self.wake)
            if waits_for.waiter is self:
                waits_for.waiter = None
        self.turn = 0  # it may wait once more, to clean up: not for this any longer

    async def ended(self) -> None:
        """Wait until it is over, even if it is cancelled."""
        over: Future[None] = Future()
        self.watch(lambda _: over.set(None))
        await over
        if not isinstance(self.error, Cancelled):
            self.result()

    def drop(self) -> None:
        """Forget it where it waits: the run is over, for it at least."""
        self._wait_no_longer()
        self._kernel.tasks.pop(self, None)
        self._coroutine.close()


class Kernel:
    """The events to come, and the coroutines that wait for them."""

    def __init__(self) -> None:
        self.now = 0.0
        """Seconds since the start, of the instant whose events are being taken."""
        self.tasks: dict[Task[Any], None] = {}
        """The coroutines that have not ended, in the order in which they set out."""
        self.crashed: BaseException | None = None
        self.over = False
        """What is run for is done, or something crashed: no further event is taken."""
        self.count = 0
        """How many events there were: what is asked for first comes first, all else being equal."""
        self.ready: list[tuple[Key, int, Task[Any]]] = []
        """The coroutines that go on at this instant, with the number of their turn."""
        self.last: Callable[[], object] | None = None
        """What is called when all else of this instant is done: the fleet's queue is served."""
        self.settled: Callable[[], object] | None = None
        """What is called when all of an instant has been taken: its events are written down."""
        self._heap: list[tuple[float, int, Key, int, Call]] = []

    def time(self) -> float:
        """Return the seconds since the start; asked between events it is later than `now`."""
        return self.now

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight, local time."""
        raise NotImplementedError

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Call this at a time, unless it is cancelled; a time that has passed means now."""
        timer = Timer(call)
        self.schedule(when, kind, key, timer)
        return timer

    def schedule(self, when: float, kind: EventKind, key: Key, call: Call) -> None:
        """Call this at a time, in any case; a time that has passed, or is none, means now."""
        self.count = count = self.count + 1
        if not when > self.now:
            when = self.now
        heappush(self._heap, (when, kind, key, count, call))

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Set a coroutine on its way; it begins when its turn comes."""
        task = Task(self, coroutine, key, name)
        task.wake()
        return task

    def under_way(self) -> Sequence[Task[Any]]:
        """Return the coroutines that have not ended, in the order in which they set out."""
        return tuple(self.tasks)

    async def sleep(
        self, seconds: float, kind: EventKind = EventKind.CLOCK, key: Key = FLEET
    ) -> None:
        """Wait for so many seconds."""
        over: Future[None] = Future()
        timer = self.at(self.now + seconds, kind, key, lambda: over.set(None))
        try:
            await over
        finally:
            timer.cancel()

    async def within(self, future: Future[Any], until: float, kind: EventKind, key: Key) -> bool:
        """Wait until it happens or the time comes; say whether it has happened."""
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

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook of the app's, `def` or `async def`, and return what it returns."""
        raise NotImplementedError

    def offer(self, future: Future[T]) -> Coroutine[Any, Any, T]:
        """Return what a hook may await for this future."""
        raise NotImplementedError

    def post(self, call: Callable[..., object], *args: object) -> None:
        """Tell the kernel something: an answer of a drone, of a hook, of a person."""
        call(*args)

    def crash(self, error: BaseException) -> None:
        """Remember an error that no coroutine caught: the driver stops and raises it."""
        if self.crashed is None:
            self.crashed = error
        self.over = True

    def close(self) -> None:
        """Drop what still waits; nothing of it runs on."""
        for task in self.under_way():
            task.drop()
        unfreeze()

    def next_time(self) -> float | None:
        """Return the time of the next event to come; None: nothing will ever happen."""
        if self.ready or self.last is not None:
            return self.now
        heap = self._heap
        while heap and isinstance(heap[0][4], Timer) and heap[0][4].cancelled:
            heappop(heap)
        return heap[0][0] if heap else None

    def drain(self) -> None:
        """Take all events of this instant, in order, and those that come of them."""
        heap, ready, now = self._heap, self.ready, self.now
        while not self.over:
            if ready:
                _, turn, task = heappop(ready)
                if turn == task.turn:
                    task.turn = 0
                    task.step()
            elif heap and heap[0][0] <= now and (heap[0][1] < _LAST or self.last is None):
                heappop(heap)[4]()
            elif self.last is not None:
                last, self.last = self.last, None
                last()
            else:
                return


_LAST = int(EventKind.ALLOCATE)
