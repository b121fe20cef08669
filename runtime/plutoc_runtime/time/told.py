"""The time of a brain: its caller tells it what time it is, and which hooks have ended.

In virtual time it jumps to the next event by itself, so a day is simulated in a moment.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from functools import partial
from typing import Any, Protocol, TypeVar

from .hours import Hours
from .kernel import EventKind, Future, Kernel, Key, Watcher

T = TypeVar("T")

ONLY_WHAT_IS_READY = (None,)
"""Runs the coroutines that are ready, and nothing that waits for its time."""


class Stuck(RuntimeError):
    """Nothing will ever happen again, and something still waits."""


class HookRunner(Protocol):
    """Runs the app's hooks, which may take their time: docs/seam.md says what is asked of it."""

    def now(self) -> float: ...
    def start(
        self, number: int, hook: Callable[..., object], call: Callable[[], object]
    ) -> bool: ...
    def result(self, number: int) -> object: ...
    def cancel(self, number: int) -> None: ...
    def offer(self, watch: Callable[[Watcher], object]) -> Awaitable[object] | None: ...
    def stirred(self) -> None: ...
    def deliver(self, call: Callable[[], T]) -> T: ...


class ToldTime(Kernel):
    """The kernel of a brain. Without a runner hooks are called at once, in virtual time."""

    def __init__(self, runner: HookRunner | None = None, hours: Hours | None = None) -> None:
        super().__init__()
        self.runner = runner
        self.hours = hours or Hours()
        """When hours come, in seconds since the start by the clock."""
        self.drift = 0.0
        """By how much the clock has gone on more than `now` since the start: it was set, or the computer slept."""
        self.on_drift: Callable[[], object] | None = None
        self._waits: dict[Future[Any], None] = {}
        """Of each that waits for an hour: set when it must ask again."""
        self._inside = runner is None
        """Whether the brain is being called: without a runner, nothing happens between two calls."""
        self.hooks: dict[int, Future[None]] = {}
        """The hooks that take their time, by their numbers; each is set when it has ended."""
        self.calls = 0  # the number of the hook that was called last

    def call(
        self,
        now: float,
        until_any: Sequence[object],
        call: Callable[[Any], T],
        given: object = None,
    ) -> T:
        """Make a call at a time, and process what follows; raise the error with which a task crashed."""
        self.now, self._inside = now, True
        try:
            returned = call(given)
            self.drain(until_any)
        finally:
            self._inside = self.runner is None
        if self.crashed is not None:
            raise self.crashed
        return returned

    def time(self) -> float:
        """Return the seconds since the start; between two calls of the brain it goes on."""
        if self._inside or self.runner is None:
            return self.now
        return max(self.now, self.runner.now())

    @property
    def clock(self) -> float:
        """Seconds since the start, by the clock that says which hour it is."""
        return self.now + self.drift

    def drifted(self, drift: float) -> None:
        """Take over how the clock stands: whatever waits for an hour asks again when that is."""
        self.drift = drift
        if self.on_drift is not None:
            self.on_drift()
        for woken in self._waits:
            woken.set(None)

    async def before(
        self, future: Future[Any], moment: Callable[[], float], kind: EventKind, key: Key
    ) -> bool:
        """Wait until the future is set or a moment comes, and return whether it was set.

        The moment is asked for again each time that the clock has moved.
        """
        while True:
            woken = Future[Any]()
            self._waits[woken] = None
            future.watch(woken.set)
            try:
                await self.within(woken, moment(), kind, key)
            finally:
                del self._waits[woken]
                future.unwatch(woken.set)
            if future.is_set or not self.now < moment():
                return future.is_set

    def post(self, call: Callable[..., T], *args: object) -> T:
        """Make a call within the kernel, for a hook that runs outside of it."""
        if self._inside or self.runner is None:
            return call(*args)
        return self.runner.deliver(partial(self._posted, call, *args))

    def _posted(self, call: Callable[..., T], *args: object) -> T:
        returned = self.call(self.time(), ONLY_WHAT_IS_READY, lambda _: call(*args))
        if self.runner is not None:
            self.runner.stirred()
        return returned

    def hook_ended(self, message: Mapping[str, Any]) -> None:
        """Called when a hook that took its time has ended."""
        if message["hook"] in self.hooks:
            self.hooks[message["hook"]].set(None)


class VirtualTime(ToldTime):
    """A kernel that runs by itself."""

    def run(self, done: Future[T], until: float | None = None) -> bool:
        """Run until this future is set, or until a time; return whether it was set."""
        done.watch(self._stop)
        while not done.is_set and self.crashed is None:
            self.over = False
            when = self.next_time()
            if when is None:
                waiting = ", ".join(sorted(task.name for task in self.tasks))
                raise Stuck(f"nothing will ever happen again; waiting: {waiting}")
            if until is not None and when > until:
                self.now = until
                return False
            self.now = when
            self.drain()
            if self.settled is not None:
                self.settled()
        if self.crashed is not None:
            raise self.crashed
        return True

    def _stop(self, _: object) -> None:
        self.over = True
