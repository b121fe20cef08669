"""Virtual time: the clock jumps to the next event, so a day is simulated in a moment."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Generator
from functools import partial
from types import CoroutineType, coroutine
from typing import Any, TypeVar, cast

from ..domain.errors import ANY_ERROR
from ..domain.guard import by_a_person, guarded
from .future import Future
from .kernel import ForeignAwait, Kernel

T = TypeVar("T")


class Stuck(RuntimeError):
    """Deadlock: no event is scheduled, and coroutines still wait."""


class VirtualTime(Kernel):
    """The kernel of simulations. Its day begins at midnight."""

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight: the simulation starts then."""
        return self.now % 86_400

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

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Call a hook; an `async def` may await only what its context offers."""
        return await self.finished(guarded(partial(hook, *args, **named)))

    async def finished(self, result: object) -> object:
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

    async def offer(self, future: Future[T]) -> T:
        """Return what a hook may await for this future."""
        return await future


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
