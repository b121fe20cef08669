"""The time of a brain: its caller tells it what time it is, and which hooks have ended."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Any, Protocol, TypeVar

from .future import Future, Watcher
from .kernel import Kernel

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


class ToldTime(Kernel):
    """The kernel of a brain. Without a runner hooks are called at once, in virtual time."""

    def __init__(self, runner: HookRunner | None = None, midnight: float = 0.0) -> None:
        """`midnight`: the seconds between the midnight before the start and the start."""
        super().__init__()
        self.runner, self._midnight = runner, midnight
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
    def time_of_day(self) -> float:
        """Seconds since midnight."""
        return (self._midnight + self.now) % 86_400

    def post(self, call: Callable[..., T], *args: object) -> T:
        """Make a call within the kernel, for a hook that runs outside of it."""
        if self._inside or self.runner is None:
            return call(*args)
        returned = self.call(self.time(), ONLY_WHAT_IS_READY, lambda _: call(*args))
        self.runner.stirred()
        return returned

    def hook_ended(self, message: Mapping[str, Any]) -> None:
        """Called when a hook that took its time has ended."""
        if message["hook"] in self.hooks:
            self.hooks[message["hook"]].set(None)
