"""The time of a brain: its caller tells it what time it is, and runs its hooks."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Coroutine, Generator, Mapping, Sequence
from functools import partial
from types import CoroutineType, coroutine
from typing import Any, Protocol, TypeVar, cast

from ..domain.errors import ANY_ERROR
from ..domain.guard import by_a_person, guarded
from .future import Future, Watcher
from .kernel import Call, EventKind, ForeignAwait, Kernel, Key, Timer

T = TypeVar("T")

ONLY_WHAT_IS_READY = (None,)
"""Runs the coroutines that are ready, and nothing that waits for its time."""


class Stuck(RuntimeError):
    """Nothing will ever happen again, and something still waits."""


class HookRunner(Protocol):
    """Runs the app's hooks, which may take their time."""

    def now(self) -> float:
        """Return the seconds since the app's start, also between two calls of the brain."""
        ...

    def start(self, number: int, hook: Callable[..., object], call: Callable[[], object]) -> bool:
        """Call a hook; return whether it has ended. If not, the brain is told `{"hook": number}` later."""
        ...

    def result(self, number: int) -> object:
        """Return what a hook that has ended returned, or raise what it raised; asked once.

        A coroutine is run here, in the brain's own time.
        """
        ...

    def cancel(self, number: int) -> None:
        """Cancel a hook: its result is not wanted any more."""
        ...

    def offer(self, watch: Callable[[Watcher], object]) -> Awaitable[object] | None:
        """Return what a hook can await; `watch` has it called when the hook shall go on.

        None: its hooks are coroutines that run here.
        """
        ...

    def stirred(self) -> None:
        """Called when a hook has changed, between two calls of the brain, what is due or ordered."""
        ...


class ToldTime(Kernel):
    """The kernel of a brain. Without a runner hooks are called at once, in virtual time."""

    def __init__(self, runner: HookRunner | None = None, midnight: float = 0.0) -> None:
        """`midnight`: the seconds between the midnight before the start and the start."""
        super().__init__()
        self._runner, self._midnight = runner, midnight
        self._inside = runner is None
        """Whether the brain is being called: without a runner, nothing happens between two calls."""
        self._hooks: dict[int, Future[None]] = {}
        """The hooks that take their time, by their numbers."""
        self._calls = 0

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
            self._inside = self._runner is None
        if self.crashed is not None:
            raise self.crashed
        return returned

    def time(self) -> float:
        """Return the seconds since the start; between two calls of the brain it goes on."""
        if self._inside or self._runner is None:
            return self.now
        return max(self.now, self._runner.now())

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight."""
        return (self._midnight + self.now) % 86_400

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Schedule a call that can be cancelled; hooks may do so between two calls of the brain."""
        self.now = self.time()
        timer = super().at(when, kind, key, call)
        self._stirred()
        return timer

    def post(self, call: Callable[..., object], *args: object) -> None:
        """Make a call within the kernel, for a hook that runs outside of it."""
        if self._inside:
            call(*args)
        else:
            self.call(self.time(), ONLY_WHAT_IS_READY, lambda _: call(*args))
            self._stirred()

    def _stirred(self) -> None:
        if not self._inside and self._runner is not None:
            self._runner.stirred()

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Call one of the app's hooks, `def` or `async def`, and return its result."""
        runner = self._runner
        if runner is None:
            return await _finished(guarded(partial(hook, *args, **named)))
        self._calls = number = self._calls + 1
        if not runner.start(number, hook, partial(hook, *args, **named)):
            ended = self._hooks[number] = Future[None]()
            try:
                await ended
            finally:
                del self._hooks[number]
                if not ended.is_set:
                    runner.cancel(number)
        return await _finished(guarded(partial(runner.result, number)))

    def hook_ended(self, message: Mapping[str, Any]) -> None:
        """Called when a hook that took its time has ended."""
        if message["hook"] in self._hooks:
            self._hooks[message["hook"]].set(None)

    async def offer(self, future: Future[T]) -> T:
        """Return what a hook may await for this future."""
        waits = None if self._runner is None else self._runner.offer(future.watch)
        if waits is None:
            return await future
        await waits
        return future.result()


async def _finished(result: object) -> object:
    """Return what a hook has returned; a coroutine is run to its end."""
    if not issubclass(type(result), CoroutineType):  # a hook's result may lie about its class
        return result
    waiting = cast("Coroutine[Any, Any, object]", result)
    try:
        return await _run_cancellable(waiting)
    except RuntimeError as error:
        if isinstance(error, ForeignAwait) or "no running event loop" in str(error):
            raise RuntimeError(
                "in a simulation a hook may await only what its context offers "
                "(context.sleep, context.trip_ended), not asyncio"
            ) from error
        raise


@coroutine
def _run_cancellable(hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Run a hook inside this coroutine; a cancelled one cannot catch that and run on."""
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = guarded(step)
        except StopIteration as end:
            returned: T = end.value
            return returned
        try:
            yield waits_for
            step = partial(hook.send, None)
        except ForeignAwait as error:
            step = partial(hook.throw, error)
        except BaseException as error:
            for call in (partial(hook.throw, error), hook.close):
                try:
                    call()
                except ANY_ERROR as its_own:  # its result is not wanted any more
                    if by_a_person(its_own):
                        raise
            raise
